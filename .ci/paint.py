"""Writes an OBJ mesh as PLY with a colour for each vertex, by its place.

Usage: paint.py MESH.obj PAINTED.ply
"""

import sys


def main():
    source, target = sys.argv[1:]
    vertices, faces = [], []
    with open(source, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append([float(x) for x in words[1:4]])
            elif words[:1] == ["f"]:
                faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    low = [min(v[k] for v in vertices) for k in range(3)]
    high = [max(v[k] for v in vertices) for k in range(3)]
    with open(target, "w", encoding="utf-8") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\n")
        for name in "xyz":
            file.write(f"property float {name}\n")
        for name in ("red", "green", "blue"):
            file.write(f"property uchar {name}\n")
        file.write(f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
        for v in vertices:
            colour = [round(255 * (v[k] - low[k]) / (high[k] - low[k])) for k in range(3)]
            file.write(" ".join(map(str, [*v, *colour])) + "\n")
        for face in faces:
            file.write(" ".join(map(str, [len(face), *face])) + "\n")


main()
