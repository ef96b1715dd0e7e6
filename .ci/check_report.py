"""Checks tatamu's report: schema 1, foldability, and that nothing too narrow goes unsaid.

Usage: check_report.py REPORT.json [LEAST_PANEL_WIDTH_MM]
"""

import json
import math
import sys

GAP_SHARE = 1e-9
DEFAULT_WIDTH_MM = 3.0

faults = []


def require(holds, fault):
    if not holds:
        faults.append(fault)
    return bool(holds)


def keys(thing, names, where):
    """Whether an object has all the keys."""
    if not require(isinstance(thing, dict), f"{where} is no object"):
        return False
    missing = [name for name in names.split() if name not in thing]
    return require(not missing, f"{where} lacks {', '.join(missing)}")


def is_number(value, least=-math.inf, most=math.inf):
    is_real = isinstance(value, (int, float)) and not isinstance(value, bool)
    return is_real and math.isfinite(value) and least <= value <= most


def check_profile(profile, where):
    if keys(profile, "vertices fold_vertices gap_mm mean_segment_mm", where):
        # A convex chain folds back at one vertex between its ends.
        folds, last = profile["fold_vertices"], profile["vertices"] - 1
        require(len(folds) == 1 and 0 < folds[0] < last, f"{where}: folds {folds} of {last + 1} vertices")
        gap, mean = profile["gap_mm"], profile["mean_segment_mm"]
        if require(is_number(gap) and is_number(mean, 0), f"{where}: gap {gap}, mean {mean}"):
            require(abs(gap) <= GAP_SHARE * mean, f"{where}: gap {gap} mm, mean segment {mean} mm")


def check_placement(matrix, where):
    """A 4×4 matrix by columns: a rotation and a translation."""
    good = isinstance(matrix, list) and len(matrix) == 16 and all(map(is_number, matrix))
    if require(good, f"{where}: placement is {matrix}"):
        columns = [matrix[4 * k : 4 * k + 4] for k in range(4)]
        for a in range(3):
            for b in range(a + 1):
                dot = sum(x * y for x, y in zip(columns[a], columns[b]))
                require(abs(dot - (a == b)) < 1e-9, f"{where}: placement is not rigid")
        require([c[3] for c in columns] == [0, 0, 0, 1], f"{where}: placement is not affine")


def check_component(component, report, least_width_mm):
    where = f"component {component.get('name')}"
    names = (
        "name faces fold_axis direction_deg top_edges profiles hausdorff_mm hausdorff_ratio"
        " min_panel_width_mm parent joint placement"
    )
    if not keys(component, names, where):
        return
    axis = component["fold_axis"]
    if require(len(axis) == 3 and all(map(is_number, axis)), f"{where}: fold_axis is {axis}"):
        require(abs(math.hypot(*axis) - 1) < 1e-9, f"{where}: fold_axis is no unit vector")
    profiles, edges = component["profiles"], component["top_edges"]
    require(len(profiles) == edges, f"{where}: {len(profiles)} profiles for {edges} top edges")
    for k, profile in enumerate(profiles):
        check_profile(profile, f"{where}, profile {k}")
    distance, ratio = component["hausdorff_mm"], component["hausdorff_ratio"]
    if require(is_number(distance, 0) and is_number(ratio, 0), f"{where}: Hausdorff {distance}, {ratio}"):
        expected = distance / report["input"]["diagonal_mm"]
        require(abs(ratio - expected) <= 1e-9, f"{where}: hausdorff_ratio {ratio} is not {expected}")
    check_placement(component["placement"], where)
    check_width(component, report, least_width_mm, where)
    check_parent(component, report, where)


def check_width(component, report, least_width_mm, where):
    width = component["min_panel_width_mm"]
    if require(is_number(width, 0), f"{where}: min_panel_width_mm is {width}"):
        told = any(
            warning["code"] == "narrow_panel" and warning["message"].startswith(component["name"] + ": ")
            for warning in report["warnings"]
        )
        fault = f"{where}: a panel is {width} mm wide and no warning names it"
        require(width >= least_width_mm - 1e-9 or told, fault)


def check_parent(component, report, where):
    parent, joint = component["parent"], component["joint"]
    require((parent is None) == (joint is None), f"{where}: parent {parent} with joint {joint}")
    if parent is not None:
        names = [other["name"] for other in report["components"]]
        require(parent in names and parent != component["name"], f"{where}: its parent is {parent}")
        if keys(joint, "parent_panel child_panel support_ratio", f"{where}, joint"):
            ratio = joint["support_ratio"]
            require(is_number(ratio, 0, 1 + 1e-9), f"{where}: support_ratio is {ratio}")


def check_tree(components):
    parents = {c["name"]: c["parent"] for c in components}
    require(len(parents) == len(components), "two components have one name")
    roots = [name for name, parent in parents.items() if parent is None]
    require(len(roots) >= 1, "no component is a root")
    for name in parents:
        seen, at = set(), name
        while at is not None and at not in seen:
            seen.add(at)
            at = parents.get(at)
        require(at is None, f"component {name} is among its own ancestors")


def check_totals(report):
    nets = report["nets"] if isinstance(report["nets"], list) else [report["nets"]]
    for k, net in enumerate(nets):
        if keys(net, "pieces panels tabs cut_mm crease_mm", f"nets {k}"):
            require(is_number(net["pieces"], 1), f"nets {k}: {net['pieces']} pieces")
            require(is_number(net["cut_mm"], 0), f"nets {k}: cut_mm is {net['cut_mm']}")
            require(is_number(net["crease_mm"], 0), f"nets {k}: crease_mm is {net['crease_mm']}")
    sheets = report["sheets"]
    if keys(sheets, "count paper utilisation", "sheets"):
        require(is_number(sheets["count"], 1), f"{sheets['count']} sheets")
        require(is_number(sheets["utilisation"], 0, 1), f"utilisation is {sheets['utilisation']}")


def check(report, least_width_mm):
    if not keys(report, "schema input stages components nets sheets warnings", "the report"):
        return
    require(report["schema"] == 1, f"schema is {report['schema']}")
    is_whole = keys(report["input"], "path faces vertices diagonal_mm repairs", "input")
    for k, stage in enumerate(report["stages"]):
        if keys(stage, "name seconds", f"stage {k}"):
            require(is_number(stage["seconds"], 0), f"stage {k} took {stage['seconds']} s")
    for k, warning in enumerate(report["warnings"]):
        is_whole &= keys(warning, "code message", f"warning {k}")
    components = report["components"]
    is_whole &= require(components, "no component")
    is_whole &= all(keys(c, "name parent", f"component {k}") for k, c in enumerate(components))
    if is_whole:
        for component in components:
            check_component(component, report, least_width_mm)
        check_tree(components)
    check_totals(report)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        report = json.load(file)
    check(report, float(sys.argv[2]) if len(sys.argv) > 2 else DEFAULT_WIDTH_MM)
    for fault in faults:
        print(fault)
    if faults:
        sys.exit(f"{len(faults)} faults")
    print(f"{len(report['components'])} components: all right")


main()
