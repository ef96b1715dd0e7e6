"""Cuts and folds the sheets of a model from their SVG files alone.

Usage: check_svg.py MODEL-1.svg MODEL-2.svg ...

Of every piece the contour must be closed, every crease must divide it, and the panels and tabs
that result must hang together as a tree. Every label must stand on two of them, at edges of the
same length.
"""

import math
import re
import sys
import xml.etree.ElementTree as ElementTree
from collections import defaultdict

INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"
TOLERANCE_MM = 2e-3
LENGTH_MM = 5e-3
MM_PER_PX = 25.4 / 96
CREASES = ("MOUNTAIN", "VALLEY", "FOLD180")
LABEL = re.compile(r"^[A-Z]+[0-9]+$")

faults = []


def require(holds, fault):
    if not holds:
        faults.append(fault)
    return bool(holds)


def contours(data):
    """The corners in mm of each contour of a path, curves by their control points, and whether it is closed."""
    found = []
    for command, numbers in re.findall(r"([MLQCZ])([^MLQCZ]*)", data):
        values = [float(x) * MM_PER_PX for x in re.findall(r"-?[0-9.]+", numbers)]
        points = list(zip(values[::2], values[1::2]))
        if command == "M":
            found.append([points, False])
        elif command == "Z":
            found[-1][1] = True
        else:
            found[-1][0].extend(points)
    return found


class Piece:
    """What the files say of one piece."""

    def __init__(self, name):
        self.name = name
        self.outline = []
        self.lines = []
        self.creases = []
        self.texts = []
        self.leaders = []

    def read(self, layer, path):
        parts = contours(path.get("d", ""))
        text = path.get("aria-label")
        if layer == "CUT":
            for points, is_closed in parts:
                require(is_closed, f"{self.name}: a contour is open")
                self.outline.append(points)
        elif layer == "SLIT":
            self.lines += [points for points, _ in parts]
        elif layer in CREASES:
            self.creases += [points for points, _ in parts]
        elif layer == "LABEL" and text:
            every = [p for points, _ in parts for p in points]
            self.texts.append((text, middle(every), every))
        elif layer == "LABEL" and path.get("fill") == "none":
            self.leaders += [points for points, _ in parts]


def middle(points):
    xs, ys = zip(*points)
    return ((min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2)


def segment_distance(p, a, b):
    (x, y), (dx, dy) = (p[0] - a[0], p[1] - a[1]), (b[0] - a[0], b[1] - a[1])
    along = max(0.0, min(1.0, (x * dx + y * dy) / max(dx * dx + dy * dy, 1e-12)))
    return math.hypot(x - along * dx, y - along * dy)


class Plane:
    """The division of a piece by its lines: points, edges, faces."""

    def __init__(self, piece):
        self.points = []
        self.edges = {}
        rings = [list(zip(r, r[1:] + r[:1])) for r in piece.outline]
        opens = [list(zip(l, l[1:])) for l in piece.lines]
        segments = [(s, "cut") for line in rings + opens for s in line]
        segments += [((l[0], l[-1]), "crease") for l in piece.creases]
        ends = [(self.index(a), self.index(b), kind) for (a, b), kind in segments]
        for a, b, kind in ends:
            for c, d in self.split(a, b):
                self.edges[c, d] = self.edges[d, c] = kind
        self.faces = self.trace()

    def index(self, p):
        for k, q in enumerate(self.points):
            if math.dist(p, q) < TOLERANCE_MM:
                return k
        self.points.append(p)
        return len(self.points) - 1

    def split(self, a, b):
        """The parts of a segment between the points that lie on it."""
        p, q = self.points[a], self.points[b]
        inner = [
            k
            for k, r in enumerate(self.points)
            if k not in (a, b) and segment_distance(r, p, q) < TOLERANCE_MM
        ]
        inner.sort(key=lambda k: math.dist(self.points[k], p))
        stops = [a, *inner, b]
        return [pair for pair in zip(stops, stops[1:]) if pair[0] != pair[1]]

    def trace(self):
        """Walks round all faces; the outer one, which runs the other way, is left out."""
        around = defaultdict(list)
        for a, b in self.edges:
            p, q = self.points[a], self.points[b]
            around[a].append((math.atan2(q[1] - p[1], q[0] - p[0]), b))
        following = {}
        for a, out in around.items():
            out.sort()
            for k, (_, b) in enumerate(out):
                following[b, a] = (a, out[k - 1][1])
        faces, seen = [], set()
        for start in sorted(self.edges):
            walk, at = [], start
            while at not in seen:
                seen.add(at)
                walk.append(at)
                at = following[at]
            if walk and self.area(walk) > TOLERANCE_MM:
                faces.append(walk)
        return faces

    def area(self, walk):
        pairs = [(self.points[a], self.points[b]) for a, b in walk]
        return sum(p[0] * q[1] - q[0] * p[1] for p, q in pairs) / 2

    def holds(self, face, p):
        inside = False
        for a, b in face:
            (x, y), (u, v) = self.points[a], self.points[b]
            if (y > p[1]) != (v > p[1]) and p[0] < x + (u - x) * (p[1] - y) / (v - y):
                inside = not inside
        return inside

    def length(self, edge):
        return math.dist(*(self.points[k] for k in edge))


def check_folds(piece, plane):
    """Creases join all faces in a tree."""
    owner = {edge: f for f, face in enumerate(plane.faces) for edge in face}
    joined = list(range(len(plane.faces)))

    def root(f):
        while joined[f] != f:
            f = joined[f]
        return f

    count = 0
    for (a, b), kind in plane.edges.items():
        if kind == "crease" and a < b:
            count += 1
            sides = owner.get((a, b)), owner.get((b, a))
            if require(None not in sides, f"{piece.name}: a crease is not inside the contour"):
                one, other = map(root, sides)
                require(one != other, f"{piece.name}: a crease does not divide, or closes a ring")
                joined[one] = other
    roots = {root(f) for f in range(len(plane.faces))}
    require(len(roots) == 1, f"{piece.name}: the contour falls into {len(roots)} pieces")
    return count


def label_edge(piece, plane, text, box):
    """Length of the edge that a label is about."""
    # A leader line begins half a millimetre from its text.
    at = middle(box)
    for leader in piece.leaders:
        if min(math.dist(leader[0], p) for p in box) < 2.5:
            at = leader[-1]
    faces = [face for face in plane.faces if plane.holds(face, at)]
    if not require(len(faces) == 1, f"{piece.name}: label {text} is not on the paper"):
        return []
    creases = [e for e in faces[0] if plane.edges[e] == "crease"]
    if len(creases) == 1 and len(faces[0]) == 4:
        # It may be a tab, or a last panel.
        return [plane.length(creases[0])] + [plane.length(e) for e in faces[0] if e not in creases]
    return [plane.length(e) for e in faces[0]]


def read(files):
    pieces = {}
    for file in files:
        for layer in ElementTree.parse(file).getroot():
            name = layer.get(INKSCAPE + "label", "")
            for group in layer:
                piece = group.get(INKSCAPE + "label")
                for path in group if piece else ():
                    pieces.setdefault(piece, Piece(piece)).read(name, path)
    return pieces


def main():
    pieces = read(sys.argv[1:])
    require(pieces, "there is no piece")
    labels, faces, creases = defaultdict(list), 0, 0
    for piece in pieces.values():
        if not require(len(piece.outline) == 1, f"{piece.name}: {len(piece.outline)} contours"):
            continue
        plane = Plane(piece)
        faces += len(plane.faces)
        creases += check_folds(piece, plane)
        for text, _, box in piece.texts:
            if LABEL.match(text):
                labels[text].append(label_edge(piece, plane, text, box))
    for text, sides in sorted(labels.items()):
        if require(len(sides) == 2, f"label {text} stands in {len(sides)} places"):
            same = any(abs(a - b) < LENGTH_MM for a in sides[0] for b in sides[1])
            require(same, f"label {text} stands at edges of different lengths")
    for fault in faults[:20]:
        print(fault)
    if faults:
        sys.exit(f"{len(faults)} faults")
    print(f"{len(pieces)} pieces, {faces} faces, {creases} creases, {len(labels)} labels: all right")


main()
