"""Lines that a cutter makes of a job, ((x, y), (x, y)) in mm from the sheet's lower left corner, by readers that are
not ours: hp2xx, gcodeparser, MeerK40t for LightBurn's projects, and fcmlib (examples/fcm_lines.rs). For GP-GL and the
EBB there is none, so that they are read here by their documents alone.

Each reader fails where a command is unknown to it.
"""

import os
import re
import subprocess
import sys
import tempfile

import dxf_lines


def hpgl(job, _height):
    with tempfile.TemporaryDirectory() as folder:
        drawn_path = f"{folder}/drawn.dxf"
        command = ["hp2xx", "-t", "-x", "0", "-y", "0", "-m", "dxf", "-f", drawn_path, job]
        run = subprocess.run(command, capture_output=True, text=True)
        said = run.stdout + run.stderr
        ignored = re.search(r"HPGL command\(s\) ignored:\s*(\d+)", said)
        if run.returncode or not ignored or ignored[1] != "0":
            sys.exit(f"hp2xx did not read all of it:\n{said}")
        return [line[:2] for line in dxf_lines.segments(drawn_path)]


def gcode(job, _height):
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


def gpgl(job, height):
    """Source: Commands.md of github.com/fablabnbg/inkscape-silhouette. ETX ends a command; numbers are y,x in 1/20 mm
    from the upper left corner; M goes there with the tool up, D with it down."""
    # ESC EOT resets and has no end of its own.
    text = open(job, encoding="ascii").read().removeprefix("\x1b\x04")
    if not text.endswith("\x03"):
        sys.exit("the last command has no end")
    at, drawn = None, []
    for command in text.split("\x03")[:-1]:
        if command[0] in "MD":
            numbers = [int(number) for number in command[1:].split(",")]
            for y, x in zip(numbers[::2], numbers[1::2], strict=True):
                to = (x / 20, height - y / 20)
                if command[0] == "D":
                    drawn.append((at, to))
                at = to
        # Tool, force, speed, track enhancing, orientation, blade offset, home.
        elif not re.fullmatch(r"J1|FX\d+,1|!\d+,1|FN0|TB50,0|FC0,1,1|H", command):
            sys.exit(f"unknown command {command!r}")
    return drawn


def ebb(job, height):
    """Source: docs/ebb.html of github.com/evil-mad/EggBot. XM,ms,x,y goes so many steps, 80 a millimetre at 1/16 step
    of an AxiDraw (EM,1,1, which also makes this place home); x goes to the right, y down; SP,1 lifts the pen; HM goes
    home."""
    steps, is_down, is_on, drawn = [0, 0], True, False, []
    with open(job, encoding="ascii", newline="") as file:
        text = file.read()
    point = lambda: (steps[0] / 80, height - steps[1] / 80)
    for command in text.removesuffix("\r").split("\r"):
        name, *numbers = command.split(",")
        numbers = [int(number) for number in numbers]
        at = point()
        if name == "XM" and len(numbers) == 3 and is_on:
            steps = [a + b for a, b in zip(steps, numbers[1:])]
            if max(map(abs, (sum(numbers[1:]), numbers[1] - numbers[2]))) / numbers[0] > 25:
                sys.exit(f"{command}: more than 25 steps of a motor in a millisecond")
        elif name == "HM" and is_on:
            steps = [0, 0]
        elif name == "SP":
            is_down = numbers[0] == 0
        elif name == "EM":
            is_on, steps = numbers == [1, 1], [0, 0]
        elif name != "SC":
            sys.exit(f"unknown command {command!r}")
        if is_down and name in ("XM", "HM"):
            drawn.append((at, point()))
    if is_down or is_on:
        sys.exit("the pen is down, or the motors are on at the end")
    return drawn


def lbrn2(job, _height):
    from threading import RLock
    from types import SimpleNamespace

    from meerk40t.core.units import UNITS_PER_MM
    from meerk40t.extra.lbrn import LbrnLoader

    class Branch:
        """What the loader adds to."""

        def __init__(self):
            self.nodes = []

        def add(self, **values):
            self.nodes.append(values)
            return self

        def remove_all_children(self):
            self.nodes.clear()

        def add_reference(self, _node):
            pass

        def focus(self):
            pass

    elements = SimpleNamespace(op_branch=Branch(), elem_branch=Branch(), node_lock=RLock())
    with open(job, "rb") as source:
        LbrnLoader.parse(job, source, elements)
    paths = [node["geometry"] for node in elements.elem_branch.nodes if "geometry" in node]
    segments = [segment for path in paths for segment in path.segments[: path.index]]
    point = lambda p: (p.real / UNITS_PER_MM, p.imag / UNITS_PER_MM)
    return [(point(start), point(end)) for start, _, _, _, end in segments]


def fcm(job, height):
    """y is down from the upper edge."""
    reader = os.path.join(os.environ.get("CARGO_TARGET_DIR", "target"), "debug/examples/fcm_lines")
    run = subprocess.run([reader, job], capture_output=True, text=True)
    if run.returncode:
        sys.exit(f"fcmlib did not read it:\n{run.stderr}")
    numbers = [[float(word) for word in line.split()] for line in run.stdout.splitlines()]
    return [((a, height - b), (c, height - d)) for a, b, c, d in numbers]
