"""Builds a model from the SVG files of its sheets alone: cuts, folds and glues by what is printed.

Usage: check_svg.py MODEL-1.svg MODEL-2.svg ...

Of every piece the contour must be closed, every crease must divide it, and the panels and tabs
that result must hang together as a tree. Every label must stand on two of them, at edges of the
same length. Labels join the pieces of each component, which says at most once where to push it down, and
which has card of one colour. Each outline names a component, in a frame; that one has an outline that
names the first, and both lie on each other with the tips of their triangles. So all components become one
model, and the first sheet says in which order they are folded flat.
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
PART_OF_PIECE = re.compile(r" \d+/\d+$")
SHEET = re.compile(r"^sheet \d+ of \d+(?: · (.*) card)?$")
ORDER = re.compile(r"^fold flat in this order[^:]*: (.*)$")
LOST = "no room on the piece for "
# Corners that are cut off where an outline meets the border of a panel.
JOINT_MM = 0.1

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
        self.joints = []
        self.keys = []
        self.names = []
        self.card = None

    @property
    def component(self):
        return PART_OF_PIECE.sub("", self.name)

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
        elif layer == "GLUE" and text:
            every = [p for points, _ in parts for p in points]
            self.names.append((text, every))
        elif layer == "GLUE" and path.get("stroke") and path.get("fill") != "none":
            self.keys += [points for points, _ in parts]
        elif layer == "GLUE" and path.get("stroke-dasharray"):
            self.joints += [points for points, is_closed in parts if is_closed]
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
        self.holes = []
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
        """Walks round all faces; those round islands, such as the tab of a plug, run the other way."""
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
            elif walk and self.area(walk) < -TOLERANCE_MM:
                self.holes.append(walk)
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
    for walk in plane.holes:
        at = plane.points[walk[0][0]]
        around = [f for f, face in enumerate(plane.faces) if walk[0][::-1] not in face and plane.holds(face, at)]
        owner.update((edge, around[0]) for edge in walk if around)
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


class Sheets:
    """What the files say beside the pieces."""

    def __init__(self, files):
        self.pieces = {}
        self.order = None
        self.lost = []
        for file in files:
            root = ElementTree.parse(file).getroot()
            texts = [path.get("aria-label") for path in root.iter() if path.get("aria-label")]
            numbers = [found for found in map(SHEET.match, texts) if found]
            require(len(numbers) == 1, f"{file}: it does not say which sheet it is")
            self.lost += [entry for text in texts for entry in text.removeprefix(LOST).split("; ")]
            orders = [found for found in map(ORDER.match, texts) if found]
            self.order = self.order or (orders[0].group(1).split(", ") if orders else None)
            for layer in root:
                name = layer.get(INKSCAPE + "label", "")
                for group in layer:
                    label = group.get(INKSCAPE + "label")
                    for path in group if label else ():
                        piece = self.pieces.setdefault(label, Piece(label))
                        piece.card = numbers[0].group(1) if numbers else None
                        piece.read(name, path)


def holds(polygon, p):
    inside = False
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        if (a[1] > p[1]) != (b[1] > p[1]) and p[0] < a[0] + (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1]):
            inside = not inside
    return inside


def border_distance(polygon, p):
    return min(segment_distance(p, a, b) for a, b in zip(polygon, polygon[1:] + polygon[:1]))


def named(piece):
    """The outlines of joints with the texts in their frames, which leader lines may lead to, and their keys;
    the texts of plugs have slits in place of an outline."""
    found, left = [], list(piece.names)
    for outline in piece.joints:

        def is_its(name):
            box = name[1]
            ends = [l[-1] for l in piece.leaders if min(math.dist(l[0], p) for p in box) < 2.5]
            return any(holds(outline, p) for p in ends or [middle(box)])

        own = next((name for name in left if is_its(name)), None)
        # A text without room for a line is in the panel of its outline.
        if own is None and left:
            own = min(left, key=lambda name: border_distance(outline, middle(name[1])))
        if not require(own is not None, f"{piece.name}: an outline has no name"):
            continue
        left.remove(own)
        key = min(piece.keys, key=lambda key: border_distance(outline, key[0]))
        require(border_distance(outline, key[0]) < JOINT_MM, f"{piece.name}: no triangle points to {own[0]}")
        found.append((own[0], outline, key[0]))
    return found, [text for text, _ in left]


def centroid(polygon):
    area = x = y = 0.0
    for (a, b), (c, d) in zip(polygon, polygon[1:] + polygon[:1]):
        cross = a * d - c * b
        area, x, y = area + cross, x + (a + c) * cross, y + (b + d) * cross
    return (x / (3 * area), y / (3 * area))


def do_lie_on_each_other(one, other):
    """Whether two outlines with their keys are the same, laid face to face."""
    (first, key), (second, tip) = one, other
    mirrored, tip = [(-x, y) for x, y in second], (-tip[0], tip[1])
    start, end = complex(*centroid(mirrored)), complex(*centroid(first))
    turn = (complex(*key) - end) / (complex(*tip) - start)
    if abs(abs(turn) - 1) * abs(complex(*key) - end) > JOINT_MM:
        return False
    moved = [end + (complex(*p) - start) * turn / abs(turn) for p in mirrored]
    moved = [(z.real, z.imag) for z in moved]
    return all(border_distance(first, p) < JOINT_MM for p in moved) and all(
        border_distance(moved, p) < JOINT_MM for p in first
    )


def glue_components(pieces, letters):
    """Finds the partner of every outline; how many joints there are, and which components hang together."""
    outlines, plugs, joined = defaultdict(list), defaultdict(list), {name: name for name in letters}

    def root(name):
        while joined[name] != name:
            name = joined[name]
        return name

    full = {letter: name for name, letter in letters.items()}
    for piece in pieces:
        found, plugged = named(piece)
        for text, outline, key in found:
            partner = text if text in letters else full.get(text)
            if require(partner, f"{piece.name}: {text} is no component"):
                outlines[piece.component, partner].append((outline, key))
        for text in plugged:
            plugs[piece.component, text if text in letters else full.get(text)].append(piece)
    for table in (outlines, plugs):
        for (own, partner), places in sorted(table.items()):
            if require((partner, own) in table, f"{partner} has no place for {own}") and partner in joined:
                joined[root(own)] = root(partner)
    for (own, partner), places in sorted(outlines.items()):
        others = outlines.get((partner, own), [])
        if own < partner and require(len(places) == len(others), f"{own} and {partner} differ in outlines"):
            for place in places:
                fits = any(do_lie_on_each_other(place, other) for other in others)
                require(fits, f"the outlines of {own} and {partner} do not lie on each other")
    return (len(outlines) + len(plugs)) // 2, len({root(name) for name in letters})


def main():
    sheets = Sheets(sys.argv[1:])
    pieces = sheets.pieces
    require(pieces, "there is no piece")
    labels, faces, creases = defaultdict(list), 0, 0
    prefixes, pushed, cards = defaultdict(set), defaultdict(int), defaultdict(set)
    for piece in pieces.values():
        if not require(len(piece.outline) == 1, f"{piece.name}: {len(piece.outline)} contours"):
            continue
        plane = Plane(piece)
        faces += len(plane.faces)
        creases += check_folds(piece, plane)
        cards[piece.component].add(piece.card)
        for text, _, box in piece.texts:
            pushed[piece.component] += text.startswith("push")
            if LABEL.match(text):
                prefixes[piece.component].add(text.rstrip("0123456789"))
                labels[text].append(label_edge(piece, plane, text, box))
    # Listed on its sheet, a label is of a piece without a place.
    lost = [entry.rsplit(": ", 1) for entry in sheets.lost if ": " in entry]
    for text in [text for piece, text in lost if piece in pieces and LABEL.match(text)]:
        labels[text] += labels[text][:1]
    for text, sides in sorted(labels.items()):
        if require(len(sides) == 2, f"label {text} stands in {len(sides)} places"):
            same = any(abs(a - b) < LENGTH_MM for a in sides[0] for b in sides[1])
            require(same, f"label {text} stands at edges of different lengths")
    for name, own in prefixes.items():
        require(len(own) == 1, f"the labels of {name} begin with {sorted(own)}")
        # A top panel that is glued to another component all over is pushed by that.
        has_joint = any(piece.joints for piece in pieces.values() if piece.component == name)
        is_told = pushed[name] == 1 or (pushed[name] == 0 and has_joint)
        require(is_told, f"{name} says {pushed[name]} times where to push it down")
        require(len(cards[name]) == 1, f"{name} has card of colours {sorted(map(str, cards[name]))}")
    letters = {name: min(own) for name, own in prefixes.items()}
    require(len(set(letters.values())) == len(letters), "two components have labels of one letter")
    joints, models = glue_components(pieces.values(), letters)
    if len(letters) > 1 and require(sheets.order, "no sheet says in which order the model folds"):
        told = {re.sub("^(unplug|plug in) | to [0-9]+%$", "", step) for step in sheets.order}
        known = set(letters.values()) if told <= set(letters.values()) else set(letters)
        require(told == known, f"the order of folding is {sheets.order}")
        require(models == 1 or joints == 0, f"the components become {models} models")
    for fault in faults[:20]:
        print(fault)
    if faults:
        sys.exit(f"{len(faults)} faults")
    count = f"{len(letters)} components, {joints} joints"
    print(f"{count}, {len(pieces)} pieces, {faces} faces, {creases} creases, {len(labels)} labels: all right")


main()
