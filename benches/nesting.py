"""How well the pieces of models are nested, beside solvers that do nothing else.

Usage: nesting.py TATAMU SECONDS MESH[:PARTS] ...

    python3.12 -m venv venv && venv/bin/pip install spyrrow packingsolver shapely
    venv/bin/python benches/nesting.py target/release/tatamu 10 samples/*.obj bunny.off:5

tatamu lays out each model on A4 and takes its usual time; its DXF files have the outlines of the pieces. The very
same pieces, as far apart and at any angle, are given for so many seconds to

- sparrow (`spyrrow` on PyPI): a strip as wide as the room on a sheet, and 1 mm. Its length over the room's height says
  how many sheets it is; pieces lie where a sheet would end, so that so few sheets cannot be had.
- PackingSolver (`packingsolver` on PyPI, for Python 3.12 and later; left out where it is not installed): sheets with
  the same room. A dash where it finds no layout in time.

`full` of tatamu counts the sheet with the least on it only as far as its pieces reach. Density is the pieces' area
over the room of the sheets, or over the strip. Every layout is checked: pieces are apart and in their room.
"""

import importlib.util
import json
import math
import subprocess
import sys
import tempfile
from itertools import combinations
from pathlib import Path

import spyrrow
from shapely import affinity
from shapely.geometry import Polygon

sys.path.insert(0, str(Path(__file__).parent.parent / ".ci"))
from dxf_lines import entities  # noqa: E402

PAPER_MM = (210.0, 297.0)
MARGIN_MM = 10.0
SPACING_MM = 2.0
ROOM_WIDTH_MM = PAPER_MM[0] - 2 * MARGIN_MM
# sparrow draws places at random and finds none for a piece of the sample teapot with 0.02 mm to spare.
STRIP_WIDTH_MM = ROOM_WIDTH_MM + 1.0
# Files have three decimals; sparrow counts in single precision and asks for no more than it can see.
TOLERANCE_MM = 0.02


def outlines(path):
    """The outlines on a sheet; what is cut within one, such as the place of a plug, is no piece."""
    found = []
    for kind, codes in entities(path):
        if kind == "LWPOLYLINE" and codes["8"] == ["CUT"] and int(codes["70"][0]) & 1:
            found.append(Polygon(zip(map(float, codes["10"]), map(float, codes["20"]))))
    return [p for p in found if not any(q is not p and q.contains(p) for q in found)]


def laid_out(tatamu, argument):
    """The pieces on each sheet, and the report."""
    mesh, _, parts = argument.partition(":")
    with tempfile.TemporaryDirectory() as folder:
        command = [tatamu, "make", mesh, "-q", "-o", f"{folder}/a.dxf", "-o", f"{folder}/a.json"]
        command += ["--paper", "a4", "--margin", f"{MARGIN_MM}mm", "--spacing", f"{SPACING_MM}mm"]
        made = subprocess.run(command + (["--parts", parts] if parts else []), capture_output=True, text=True)
        if made.returncode:
            sys.exit(made.stderr)
        report = json.loads(Path(folder, "a.json").read_text(encoding="utf-8"))
        sheets = [outlines(path) for path in sorted(Path(folder).glob("*.dxf"))]
    if len(sheets) != report["sheets"]["count"]:
        sys.exit(f"{argument}: {len(sheets)} files for {report['sheets']['count']} sheets")
    return sheets, report


def check(name, pieces, room):
    """Stops where pieces are nearer than the spacing or stick out of (least x, least y, largest x, largest y)."""
    near = min((a.distance(b) for a, b in combinations(pieces, 2)), default=math.inf)
    out = max(max(room[0] - x, room[1] - y, u - room[2], v - room[3]) for x, y, u, v in (p.bounds for p in pieces))
    if near < SPACING_MM - TOLERANCE_MM or out > TOLERANCE_MM:
        sys.exit(f"{name}: pieces are {near:.3f} mm apart and stick out by {out:.3f} mm")


def moved(piece, angle_deg, way):
    """A piece turned about the origin, then moved."""
    return affinity.translate(affinity.rotate(piece, angle_deg, origin=(0, 0)), *way)


def angles_deg(piece):
    """Angles at which a piece fits across the strip; sparrow does not find them among all where there are few."""
    turned = ((angle, moved(piece, angle, (0, 0)).bounds) for angle in range(360))
    return [angle for angle, (_, low, _, high) in turned if high - low <= ROOM_WIDTH_MM]


def strip_mm(pieces, seconds):
    """Length of the strip that sparrow finds. It keeps the spacing to the strip's borders, too."""
    items = [
        spyrrow.Item(str(k), list(piece.exterior.coords), demand=1, allowed_orientations=angles_deg(piece))
        for k, piece in enumerate(pieces)
    ]
    config = spyrrow.StripPackingConfig(
        early_termination=False, min_items_separation=SPACING_MM, total_computation_time=seconds, seed=0
    )
    strip = spyrrow.StripPackingInstance("pieces", STRIP_WIDTH_MM + 2 * SPACING_MM, items).solve(config)
    placed = [moved(pieces[int(p.id)], p.rotation, p.translation) for p in strip.placed_items]
    check("sparrow", placed, (SPACING_MM, SPACING_MM, strip.width - SPACING_MM, SPACING_MM + STRIP_WIDTH_MM))
    return strip.width - 2 * SPACING_MM


def packed_sheets(pieces, height_mm, seconds):
    """Number of sheets that PackingSolver finds; None where it finds no layout in time."""
    from packingsolver import irregular

    builder = irregular.InstanceBuilder()
    builder.set_objective(irregular.Objective.BinPacking)
    builder.set_item_item_minimum_spacing(SPACING_MM)
    builder.add_bin_type(irregular.build_rectangle(0, ROOM_WIDTH_MM, 0, height_mm), copies=len(pieces))
    for piece in pieces:
        corners = list(piece.normalize().exterior.coords)[:0:-1]
        builder.add_item_type(irregular.build_shape(corners), allowed_rotations=[(0, 360, False)])
    parameters = irregular.OptimizeParameters()
    parameters.time_limit = seconds
    parameters.verbosity_level = 0
    solution = irregular.optimize(builder.build(), parameters).solution
    if not solution.full():
        return None
    for sheet in range(solution.number_of_different_bins()):
        items = solution.bin(sheet).items
        placed = [moved(pieces[p.item_type_id], p.angle, (p.bl_corner.x, p.bl_corner.y)) for p in items]
        check("PackingSolver", placed, (0, 0, ROOM_WIDTH_MM, height_mm))
    return solution.number_of_bins()


def main():
    tatamu, seconds, *arguments = sys.argv[1:]
    seconds = int(seconds)
    has_packing_solver = importlib.util.find_spec("packingsolver") is not None
    print("| model | pieces | sheets | full | density | strip | density | PackingSolver |")
    print("|---|---|---|---|---|---|---|---|")
    sums = [0, 0.0, 0.0, 0]
    for argument in arguments:
        sheets, report = laid_out(tatamu, argument)
        pieces = [piece for sheet in sheets for piece in sheet]
        area_mm2 = sum(piece.area for piece in pieces)
        height_mm = area_mm2 / report["sheets"]["utilisation"] / len(sheets) / ROOM_WIDTH_MM
        low_mm = PAPER_MM[1] - MARGIN_MM - height_mm
        for sheet in sheets:
            check(argument, sheet, (MARGIN_MM, low_mm, MARGIN_MM + ROOM_WIDTH_MM, low_mm + height_mm))
        reach_mm = min(max(piece.bounds[3] for piece in sheet) - low_mm for sheet in sheets)
        full = len(sheets) - 1 + reach_mm / height_mm
        length_mm = strip_mm(pieces, seconds)
        strip = length_mm / height_mm
        packed = packed_sheets(pieces, height_mm, seconds) if has_packing_solver else None
        densities = [
            area_mm2 / (ROOM_WIDTH_MM * height_mm * len(sheets)),
            area_mm2 / (STRIP_WIDTH_MM * length_mm),
        ]
        print(
            f"| {Path(argument).stem} | {len(pieces)} | {len(sheets)} | {full:.2f} | {densities[0]:.0%} "
            f"| {strip:.2f} | {densities[1]:.0%} | {'–' if packed is None else packed} |",
            flush=True,
        )
        sums = [a + b for a, b in zip(sums, (len(sheets), full, strip, packed or 0))]
    print(f"| all | | {sums[0]} | {sums[1]:.2f} | | {sums[2]:.2f} | | {sums[3] or '–'} |")


if __name__ == "__main__":
    main()
