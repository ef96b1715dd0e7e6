"""A PDF by pikepdf: lengths by its own operators as reported, layers, bookmarks, no date.

Usage: check_pdf.py REPORT.json FILE.pdf
"""

import json
import math
import sys

import pikepdf

TOLERANCE_MM = 0.01
MM_PER_PT = 25.4 / 72
CUTS = {"CUT", "SLIT"}
CREASES = {"MOUNTAIN", "VALLEY", "FOLD180"}

faults = []


def require(holds, fault):
    if not holds:
        faults.append(fault)


def layer_names(page):
    properties = page.Resources.get("/Properties", {})
    return {key: str(group.Name) for key, group in properties.items()}


def lengths(page):
    """Millimetres that are stroked, by layer. Nothing may be scaled."""
    names, stack, out = layer_names(page), [], {}
    path, start, at = 0.0, None, None
    for operands, operator in pikepdf.parse_content_stream(page):
        name = str(operator)
        numbers = lambda: [float(x) for x in operands]
        if name in ("BDC", "BMC"):
            stack.append(names.get(str(operands[1]), "") if name == "BDC" else "")
        elif name == "EMC":
            stack.pop()
        elif name == "cm":
            faults.append("a page is transformed")
        elif name == "m":
            start = at = numbers()
        elif name == "l":
            path += math.dist(at, numbers())
            at = numbers()
        elif name in ("h", "s"):
            path += math.dist(at, start)
            at = start
        if name in ("S", "s"):
            layer = stack[-1] if stack else ""
            out[layer] = out.get(layer, 0.0) + path * MM_PER_PT
        if name in ("S", "s", "f", "f*", "n", "B", "B*"):
            path = 0.0
    return out


def titles(items):
    return [item.title for item in items]


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        report = json.load(file)
    with pikepdf.open(sys.argv[2]) as pdf:
        pages = report["sheets"]["pages"]
        require(len(pdf.pages) == len(pages), f"{len(pdf.pages)} pages for {len(pages)} sheets")
        for number, (page, expected) in enumerate(zip(pdf.pages, pages), 1):
            found = lengths(page)
            for key, layers in (("cut_mm", CUTS), ("crease_mm", CREASES)):
                total = sum(found.get(layer, 0.0) for layer in layers)
                # The legend shows lines of its own, but on the layer of the furniture.
                near = abs(total - expected[key]) <= TOLERANCE_MM
                require(near, f"page {number}: {key} is {total}, reported {expected[key]}")
        groups = {str(group.Name) for group in pdf.Root.OCProperties.OCGs}
        require({"CUT", "MOUNTAIN", "FOLD180", "LABEL"} <= groups, f"layers {groups}")
        with pdf.open_outline() as outline:
            names = [component["name"] for component in report["components"]]
            require(titles(outline.root) == names, f"bookmarks {titles(outline.root)} for {names}")
            for item, net in zip(outline.root, report["nets"]):
                below = len(item.children) or 1
                require(below == net["pieces"], f"{item.title}: {below} bookmarks for its pieces")
        info = pdf.trailer.get("/Info", {})
        require("/Title" in info and "/Creator" in info, f"information {list(info.keys())}")
        require("/CreationDate" not in info, "a date without SOURCE_DATE_EPOCH")
    for fault in faults[:20]:
        print(fault)
    if faults:
        sys.exit(f"{len(faults)} faults")
    print(f"{len(pages)} pages: lengths as reported; {len(groups)} layers, {len(names)} bookmarks")


main()
