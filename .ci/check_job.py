"""Compares jobs, each read by a program that is not ours, with the DXF files of the same sheets.

    check_job.py LANGUAGE[:BLADE_OFFSET_MM] JOB SHEET.dxf [JOB SHEET.dxf ...]

LANGUAGE is that of the jobs: the name of a function of job_readers.py. Fails where the reader does not know a
command, and where a line of the one is farther than the tolerance from the lines of the other. A job has to be
that of a pen or a laser without overcut, so that both are the same geometry. With a blade's offset it is that of a
drag knife, whose tip is simulated.
"""

import math
import sys

import dxf_lines
import job_readers

TOLERANCE_MM = 0.025
KNIFE_TOLERANCE_MM = 0.05
# A unit of GP-GL is 0.05 mm: rounded, a corner is up to 0.036 mm off.
COARSE_TOLERANCE_MM = 0.04
COARSE = {"gpgl"}
# A blade that points along its way to so many radians does not turn any more.
ALIGNED = 1e-4
SKIPPED_LAYERS = {"0"}
# Knives, and ScanNCut's files, leave labels out.
WITHOUT_PEN = {"fcm", "gpgl"}
DRAWN_LAYERS = {"GLUE", "LABEL", "ENGRAVE"}


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


def tip(shaft, offset, direction):
    """The way of a blade's tip behind its shaft, and where the blade points at last: each step turns it by the
    tractrix, tan(a/2) = tan(a0/2) exp(-s/r)."""
    way = [(shaft[0][0] - offset * math.cos(direction), shaft[0][1] - offset * math.sin(direction))]
    for (ax, ay), (bx, by) in zip(shaft, shaft[1:]):
        length, along = math.hypot(bx - ax, by - ay), math.atan2(by - ay, bx - ax)
        steps = max(1, math.ceil(length / 0.05))
        for k in range(1, steps + 1):
            angle = math.remainder(direction - along, math.tau)
            direction = along + 2 * math.atan(math.tan(angle / 2) * math.exp(-length / steps / offset))
            if abs(angle) < ALIGNED:
                k = steps
            x, y = ax + (bx - ax) * k / steps, ay + (by - ay) * k / steps
            way.append((x - offset * math.cos(direction), y - offset * math.sin(direction)))
            if k == steps:
                break
    return way, direction


def cut_by_knife(shaft, offset):
    """The lines that the tip cuts, without the first stroke, which only turns the blade."""
    strokes = []
    for a, b in shaft:
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


def compare(language, offset, job, sheet):
    drawn = getattr(job_readers, language)(job, dxf_lines.height(sheet))
    tolerance = COARSE_TOLERANCE_MM if language in COARSE else TOLERANCE_MM
    if offset:
        drawn = cut_by_knife(drawn, offset)
        tolerance = KNIFE_TOLERANCE_MM
    skipped = SKIPPED_LAYERS | (DRAWN_LAYERS if offset or language in WITHOUT_PEN else set())
    meant = [line for line in dxf_lines.segments(sheet) if line[2] not in skipped]
    if not drawn or not meant:
        sys.exit(f"{job}: {len(drawn)} lines drawn, {len(meant)} meant")
    for name, ours, others in [("drawn, not meant", drawn, meant), ("meant, not drawn", meant, drawn)]:
        grid = Grid(others)
        worst, place = max((grid.distance(p), p) for p in samples(ours))
        print(f"{job}: {name}: {worst:.4f} mm at most, at {place[0]:.2f}, {place[1]:.2f}")
        if worst > tolerance:
            sys.exit(f"more than {tolerance} mm")


def main(language, *files):
    language, _, offset = language.partition(":")
    if not files or len(files) % 2:
        sys.exit(f"{len(files)} files are not pairs of a job and a sheet")
    for job, sheet in zip(files[::2], files[1::2]):
        compare(language, float(offset or 0), job, sheet)


main(*sys.argv[1:])
