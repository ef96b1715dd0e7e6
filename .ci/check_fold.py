"""Checks a FOLD master of tatamu from its own numbers alone.

Usage: check_fold.py MODEL.fold
"""

import json
import math
import sys
from collections import defaultdict
from itertools import combinations

TOLERANCE_MM = 1e-6
MOST_SHOWN = 20

FACE_KINDS = {"top", "bottom", "side", "tab"}
# Kinds of edges by the number of faces that meet there.
FREE_KINDS = {"border", "slit", "mate"}
JOINED_KINDS = {"hinge", "fold-hinge", "tab"}
ASSIGNMENTS = set("BMVFU")

faults = []


def require(holds, fault):
    if not holds:
        faults.append(fault)
    return bool(holds)


def stop_on_faults():
    if faults:
        for fault in faults[:MOST_SHOWN]:
            print(fault)
        sys.exit(f"{len(faults)} faults")


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def is_index(value):
    return isinstance(value, int) and not isinstance(value, bool) and value >= 0


def points_of(frame, count, name):
    """Vertices of a frame in three dimensions."""
    coords = frame.get("vertices_coords", [])
    require(len(coords) == count, f"{name}: {len(coords)} vertices instead of {count}")
    good = all(len(p) in (2, 3) and all(map(is_number, p)) for p in coords)
    require(good, f"{name}: a coordinate is not a finite number")
    stop_on_faults()
    return [tuple(map(float, p)) + (0.0,) * (3 - len(p)) for p in coords]


def check_head(fold):
    require(fold.get("file_spec") == 1.2, f"file_spec is {fold.get('file_spec')}")
    require(fold.get("frame_unit") == "mm", f"frame_unit is {fold.get('frame_unit')}")
    require("creasePattern" in fold.get("frame_classes", []), "frame 0 is no creasePattern")
    frames = fold.get("file_frames", [])
    if not require(len(frames) >= 2, f"{len(frames)} frames beside the crease pattern"):
        stop_on_faults()
    for k, frame in enumerate(frames):
        require("foldedForm" in frame.get("frame_classes", []), f"file_frames[{k}] is no foldedForm")
        require(frame.get("frame_parent") == 0, f"file_frames[{k}] has not frame 0 as its parent")
        require(frame.get("frame_inherit") is True, f"file_frames[{k}] does not inherit")
    require(frames[0].get("frame_title") == "deployed", "file_frames[0] is not 'deployed'")
    require(frames[-1].get("frame_title") == "flat", "the last frame is not 'flat'")


def check_arrays(fold):
    """Lengths and value sets of everything that goes by face or edge."""
    vertices = len(fold["vertices_coords"])
    faces, edges = fold["faces_vertices"], fold["edges_vertices"]
    for kind, things in (("faces", faces), ("edges", edges)):
        for key, values in fold.items():
            if key.startswith(kind + "_"):
                require(len(values) == len(things), f"{key}: {len(values)} for {len(things)} {kind}")
    for k, face in enumerate(faces):
        good = len(face) >= 3 and len(set(face)) == len(face)
        require(good and all(is_index(v) and v < vertices for v in face), f"face {k} is {face}")
    for k, edge in enumerate(edges):
        good = len(edge) == 2 and edge[0] != edge[1]
        require(good and all(is_index(v) and v < vertices for v in edge), f"edge {k} is {edge}")

    def values(key, allowed):
        if require(key in fold, f"no {key}"):
            for k, value in enumerate(fold[key]):
                require(allowed(value), f"{key}[{k}] is {value!r}")

    values("faces_tatamu:component", lambda v: isinstance(v, str) and v)
    values("faces_tatamu:kind", lambda v: v in FACE_KINDS)
    values("faces_tatamu:chain", lambda v: v is None or is_index(v))
    values("faces_tatamu:panel", lambda v: v is None or is_index(v))
    values("faces_tatamu:sheet", is_index)
    values("edges_tatamu:kind", lambda v: v in FREE_KINDS | JOINED_KINDS)
    values("edges_tatamu:label", lambda v: v is None or (isinstance(v, str) and v))
    values("edges_assignment", lambda v: v in ASSIGNMENTS)
    values("edges_foldAngle", lambda v: is_number(v) and abs(v) <= 180)
    stop_on_faults()
    for k, kind in enumerate(fold["faces_tatamu:kind"]):
        known = fold["faces_tatamu:chain"][k] is not None and fold["faces_tatamu:panel"][k] is not None
        require(kind != "side" or known, f"side face {k} has no chain or no panel")


def faces_at_edges(fold):
    """For each edge the faces that have it; an edge of a face that is not listed is a fault."""
    index = {frozenset(edge): k for k, edge in enumerate(fold["edges_vertices"])}
    require(len(index) == len(fold["edges_vertices"]), "an edge is listed twice")
    found = [[] for _ in fold["edges_vertices"]]
    directed = set()
    for k, face in enumerate(fold["faces_vertices"]):
        for side in zip(face, face[1:] + face[:1]):
            require(side not in directed, f"two faces run along {side} in the same direction")
            directed.add(side)
            edge = index.get(frozenset(side))
            if require(edge is not None, f"side {side} of face {k} is no edge"):
                found[edge].append(k)
    return found


def check_edges(fold, at_edges):
    kinds = fold["faces_tatamu:kind"]
    for k, (faces, kind) in enumerate(zip(at_edges, fold["edges_tatamu:kind"])):
        allowed = {1: FREE_KINDS, 2: JOINED_KINDS}.get(len(faces), set())
        require(kind in allowed, f"edge {k} is a {kind} with {len(faces)} faces")
        is_border = fold["edges_assignment"][k] == "B"
        require(is_border == (len(faces) == 1), f"edge {k} with {len(faces)} faces is assigned wrongly")
        tabs = sum(kinds[f] == "tab" for f in faces)
        if kind == "tab":
            require(tabs == 1, f"tab edge {k} joins {tabs} tabs")
        elif kind != "border":
            require(tabs == 0, f"{kind} edge {k} belongs to a tab")
        components = {fold["faces_tatamu:component"][f] for f in faces}
        sheets = {fold["faces_tatamu:sheet"][f] for f in faces}
        require(len(components) == 1 and len(sheets) == 1, f"edge {k} joins two components or sheets")


def label_pairs(fold):
    """The two edges of each label."""
    edges = defaultdict(list)
    for k, label in enumerate(fold["edges_tatamu:label"]):
        kind = fold["edges_tatamu:kind"][k]
        has_label = kind in ("tab", "mate")
        require(has_label == (label is not None), f"{kind} edge {k} has the label {label!r}")
        if label is not None:
            edges[label].append(k)
    pairs = {}
    for label, found in edges.items():
        kinds = sorted(fold["edges_tatamu:kind"][k] for k in found)
        # Two mates are joined by tape.
        is_pair = kinds in (["mate", "tab"], ["mate", "mate"])
        if require(is_pair, f"label {label} stands on {kinds}"):
            pairs[label] = found
    return pairs


def check_labels(fold, pairs, points, name):
    for label, (a, b) in pairs.items():
        p, q = ([points[v] for v in fold["edges_vertices"][k]] for k in (a, b))
        same = max(math.dist(p[0], q[0]), math.dist(p[1], q[1]))
        crossed = max(math.dist(p[0], q[1]), math.dist(p[1], q[0]))
        apart = min(same, crossed)
        require(apart <= TOLERANCE_MM, f"{name}: the edges of label {label} are {apart} mm apart")


def check_isometry(fold, flat, points, name):
    for k, face in enumerate(fold["faces_vertices"]):
        worst = max(
            abs(math.dist(points[a], points[b]) - math.dist(flat[a], flat[b]))
            for a, b in combinations(face, 2)
        )
        require(worst <= TOLERANCE_MM, f"{name}: face {k} is stretched by {worst} mm")


def normal_of(corners):
    """Newell's normal, of twice the area's length."""
    total = [0.0, 0.0, 0.0]
    for p, q in zip(corners, corners[1:] + corners[:1]):
        total[0] += (p[1] - q[1]) * (p[2] + q[2])
        total[1] += (p[2] - q[2]) * (p[0] + q[0])
        total[2] += (p[0] - q[0]) * (p[1] + q[1])
    return total


def check_flat(fold, points):
    """All faces of a component lie in the plane of its largest face."""
    components = defaultdict(list)
    for face, name in zip(fold["faces_vertices"], fold["faces_tatamu:component"]):
        # About the first corner, so that the normal does not lose digits far from the origin.
        base = points[face[0]]
        corners = [tuple(x - o for x, o in zip(points[v], base)) for v in face]
        components[name].append((math.hypot(*normal_of(corners)), normal_of(corners), face))
    for name, faces in components.items():
        area, normal, face = max(faces)
        normal, base = [x / area for x in normal], points[face[0]]
        worst = max(
            abs(sum(n * (x - o) for n, x, o in zip(normal, points[v], base)))
            for _, _, face in faces
            for v in face
        )
        require(worst <= TOLERANCE_MM, f"flat: component {name} is {worst} mm out of its plane")


def check_convex(fold, points):
    """Counter-clockwise and convex; collinear corners are allowed."""
    for k, face in enumerate(fold["faces_vertices"]):
        corners = [points[v] for v in face]
        require(normal_of(corners)[2] > 0, f"face {k} is not counter-clockwise")
        for a, b, c in zip(corners, corners[1:] + corners[:1], corners[2:] + corners[:2]):
            turn = (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
            longest = max(math.dist(a, b), math.dist(b, c))
            require(turn >= -TOLERANCE_MM * longest, f"face {k} is not convex")


def are_apart(a, b):
    """Whether an edge of polygon a has all of polygon b outside of it."""
    for p, q in zip(a, a[1:] + a[:1]):
        length = math.dist(p, q)
        if length > 0:
            x, y = (q[1] - p[1]) / length, (p[0] - q[0]) / length
            if all((r[0] - p[0]) * x + (r[1] - p[1]) * y >= -TOLERANCE_MM for r in b):
                return True
    return False


def check_overlap(fold, points):
    """Separating axes for the pairs of faces whose boxes meet, found by a sweep along x."""
    boxes = []
    for k, face in enumerate(fold["faces_vertices"]):
        corners = [points[v][:2] for v in face]
        xs, ys = zip(*corners)
        boxes.append((min(xs), max(xs), min(ys), max(ys), k, corners))
    active = []
    for box in sorted(boxes):
        active = [other for other in active if other[1] > box[0] + TOLERANCE_MM]
        for other in active:
            if other[3] > box[2] + TOLERANCE_MM and box[3] > other[2] + TOLERANCE_MM:
                apart = are_apart(box[5], other[5]) or are_apart(other[5], box[5])
                require(apart, f"faces {other[4]} and {box[4]} overlap in the crease pattern")
        active.append(box)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        fold = json.load(file)
    check_head(fold)
    check_arrays(fold)
    stop_on_faults()
    count = len(fold["vertices_coords"])
    pattern = points_of(fold, count, "crease pattern")
    require(all(p[2] == 0 for p in pattern), "the crease pattern is not in the plane z = 0")
    check_convex(fold, pattern)
    check_overlap(fold, pattern)
    at_edges = faces_at_edges(fold)
    check_edges(fold, at_edges)
    pairs = label_pairs(fold)
    for frame in fold["file_frames"]:
        name = frame.get("frame_title", "a pose")
        points = points_of(frame, count, name)
        check_isometry(fold, pattern, points, name)
        check_labels(fold, pairs, points, name)
        if frame is fold["file_frames"][-1]:
            check_flat(fold, points)
    stop_on_faults()
    faces, frames = len(fold["faces_vertices"]), len(fold["file_frames"])
    print(f"{faces} faces, {len(pairs)} labels, {frames} folded frames: all right")


main()
