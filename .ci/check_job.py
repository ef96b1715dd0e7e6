"""Reads a job with a program that is not ours, and compares it with the DXF file of the same sheet: HP-GL with
hp2xx, G-code with gcodeparser.

    check_job.py JOB.plt|JOB.gcode SHEET.dxf [BLADE_OFFSET_MM]

Fails where the program ignores a command, and where a line of the one is farther than the tolerance from
the lines of the other. The job has to be that of a pen or a laser without overcut, so that both are the same
geometry. With a blade's offset it is that of a drag knife in G-code, whose tip is simulated.
"""

import math
import re
import subprocess
import sys
import tempfile

TOLERANCE_MM = 0.025
KNIFE_TOLERANCE_MM = 0.05
SKIPPED_LAYERS = {"0"}
DRAWN_LAYERS = {"GLUE", "LABEL"}


def pairs(path):
    lines = open(path, encoding="utf-8").read().splitlines()
    return [(lines[k].strip(), lines[k + 1].strip()) for k in range(0, len(lines) - 1, 2)]


def entities(path):
    """(type, {code: [values]}) of the section ENTITIES."""
    found, is_inside, entity = [], False, None
    for code, value in pairs(path):
        if code == "2" and value == "ENTITIES":
            is_inside = True
        elif code == "0":
            if value == "ENDSEC":
                is_inside = False
            entity = (value, {}) if is_inside else None
            if entity:
                found.append(entity)
        elif entity:
            entity[1].setdefault(code, []).append(value)
    return found


def segments(path):
    out, polyline = [], None
    for kind, codes in entities(path):
        layer = codes.get("8", ["0"])[0]
        number = lambda code: [float(v) for v in codes.get(code, [])]
        if kind == "LINE":
            points, is_closed = [(number("10")[0], number("20")[0]), (number("11")[0], number("21")[0])], False
        elif kind == "LWPOLYLINE":
            points = list(zip(number("10"), number("20")))
            is_closed = int(codes.get("70", ["0"])[0]) & 1
        elif kind == "POLYLINE":
            polyline = ([], int(codes.get("70", ["0"])[0]) & 1, layer)
            continue
        elif kind == "VERTEX" and polyline:
            polyline[0].append((number("10")[0], number("20")[0]))
            continue
        elif kind == "SEQEND" and polyline:
            points, is_closed, layer = polyline
            polyline = None
        else:
            continue
        if is_closed:
            points = points + points[:1]
        out += [(a, b, layer) for a, b in zip(points, points[1:])]
    return out


def distance(p, a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = dx * dx + dy * dy
    t = 0 if length == 0 else max(0, min(1, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length))
    return math.hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy)


class Grid:
    """Segments by the cells of 5 mm that they touch."""

    SIZE = 5.0

    def __init__(self, lines):
        self.cells = {}
        for line in lines:
            (ax, ay), (bx, by) = line[:2]
            for i in range(int(min(ax, bx) // self.SIZE) - 1, int(max(ax, bx) // self.SIZE) + 2):
                for j in range(int(min(ay, by) // self.SIZE) - 1, int(max(ay, by) // self.SIZE) + 2):
                    self.cells.setdefault((i, j), []).append(line)

    def distance(self, p):
        near = self.cells.get((int(p[0] // self.SIZE), int(p[1] // self.SIZE)), [])
        return min((distance(p, a, b) for a, b, *_ in near), default=math.inf)


def samples(lines):
    for a, b, *_ in lines:
        steps = max(1, math.ceil(math.hypot(b[0] - a[0], b[1] - a[1]) / 0.5))
        for k in range(steps + 1):
            yield (a[0] + (b[0] - a[0]) * k / steps, a[1] + (b[1] - a[1]) * k / steps)


def drawn_by_hpgl(job):
    with tempfile.TemporaryDirectory() as folder:
        drawn_path = f"{folder}/drawn.dxf"
        command = ["hp2xx", "-t", "-x", "0", "-y", "0", "-m", "dxf", "-f", drawn_path, job]
        run = subprocess.run(command, capture_output=True, text=True)
        said = run.stdout + run.stderr
        ignored = re.search(r"HPGL command\(s\) ignored:\s*(\d+)", said)
        if run.returncode or not ignored or ignored[1] != "0":
            sys.exit(f"hp2xx did not read all of it:\n{said}")
        return segments(drawn_path)


def tip(shaft, offset, direction):
    """The way of a blade's tip behind its shaft, and where the blade points at last: each step turns it by the
    tractrix, tan(a/2) = tan(a0/2) exp(-s/r)."""
    way = [(shaft[0][0] - offset * math.cos(direction), shaft[0][1] - offset * math.sin(direction))]
    for (ax, ay), (bx, by) in zip(shaft, shaft[1:]):
        length, along = math.hypot(bx - ax, by - ay), math.atan2(by - ay, bx - ax)
        steps = max(1, math.ceil(length / 0.02))
        for k in range(1, steps + 1):
            angle = math.remainder(direction - along, math.tau)
            direction = along + 2 * math.atan(math.tan(angle / 2) * math.exp(-length / steps / offset))
            x, y = ax + (bx - ax) * k / steps, ay + (by - ay) * k / steps
            way.append((x - offset * math.cos(direction), y - offset * math.sin(direction)))
    return way, direction


def cut_by_knife(job, offset):
    """The lines that the tip cuts, without the first stroke, which only turns the blade."""
    strokes = []
    for a, b in drawn_by_gcode(job):
        if strokes and strokes[-1][-1] == a:
            strokes[-1].append(b)
        else:
            strokes.append([a, b])
    lines, direction = [], 2.2
    for k, stroke in enumerate(strokes):
        way, direction = tip(stroke, offset, direction)
        if k > 0:
            lines += zip(way, way[1:])
    return lines


def drawn_by_gcode(job):
    """The moves with the beam on, or with the knife near the mat."""
    from gcodeparser import parse_gcode_lines

    text = open(job, encoding="ascii").read()
    commands = list(parse_gcode_lines(text))
    # Lines of one setting, F or S, are none to it.
    written = [line for line in text.splitlines() if line.strip() and not re.fullmatch(r"[FS][0-9.]+", line)]
    if len(commands) != len(written):
        sys.exit(f"gcodeparser read {len(commands)} commands of {len(written)} lines")
    at, is_down, drawn = (0.0, 0.0), False, []
    for line in commands:
        kind, params = line.command, line.params
        if kind in (("M", 3), ("M", 4)):
            is_down = params.get("S", 1) > 0
        elif kind == ("M", 5):
            is_down = False
        elif kind in (("G", 0), ("G", 1)):
            if "Z" in params:
                is_down = params["Z"] < 1
                continue
            to = (params.get("X", at[0]), params.get("Y", at[1]))
            if kind == ("G", 0) and is_down and to != at:
                sys.exit(f"it travels with the beam on: {line}")
            if is_down:
                drawn.append((at, to))
            at = to
        elif kind[0] == "G" and kind[1] not in (4, 17, 21, 54, 90, 94):
            sys.exit(f"unexpected {line}")
    if is_down:
        sys.exit("the beam is on at the end")
    return drawn


def main(job, sheet, offset=None):
    skipped, tolerance = SKIPPED_LAYERS, TOLERANCE_MM
    if offset:
        drawn = cut_by_knife(job, float(offset))
        skipped, tolerance = SKIPPED_LAYERS | DRAWN_LAYERS, KNIFE_TOLERANCE_MM
    else:
        drawn = drawn_by_gcode(job) if job.endswith(".gcode") else drawn_by_hpgl(job)
    meant = [line for line in segments(sheet) if line[2] not in skipped]
    if not drawn or not meant:
        sys.exit(f"{len(drawn)} lines drawn, {len(meant)} meant")
    for name, ours, others in [("drawn, not meant", drawn, meant), ("meant, not drawn", meant, drawn)]:
        grid = Grid(others)
        worst, place = max((grid.distance(p), p) for p in samples(ours))
        print(f"{name}: {worst:.4f} mm at most, at {place[0]:.2f}, {place[1]:.2f}")
        if worst > tolerance:
            sys.exit(1)


main(*sys.argv[1:])
