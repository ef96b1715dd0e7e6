"""DXF files of one model by ezdxf: nothing to mend, and the report's lengths and bounding boxes.

Usage: check_dxf.py REPORT.json VERSION DXF...   (one file a sheet, or all sheets in one)
"""

import json
import math
import sys

import ezdxf
from ezdxf import bbox

TOLERANCE_MM = 0.01
CUTS = {"CUT", "SLIT"}
CREASES = {"MOUNTAIN", "VALLEY", "FOLD180"}
KNOWN = CUTS | CREASES | {"GLUE", "LABEL"}
MILLIMETRES = 4

faults = []


def require(holds, fault):
    if not holds:
        faults.append(fault)


def lines(entity):
    """The straight segments of an entity."""
    if entity.dxftype() == "LINE":
        points, is_closed = [entity.dxf.start, entity.dxf.end], False
    elif entity.dxftype() == "LWPOLYLINE":
        points, is_closed = [(x, y) for x, y, *_ in entity.get_points()], entity.closed
    elif entity.dxftype() == "POLYLINE":
        points, is_closed = [v.dxf.location for v in entity.vertices], entity.is_closed
    else:
        return []
    points = [(p[0], p[1]) for p in points]
    return list(zip(points, points[1:] + points[:1] if is_closed else points[1:]))


def check_layers(document, entities, name):
    for entity in entities:
        layer = entity.dxf.layer
        require(layer in KNOWN, f"{name}: an entity on layer {layer}")
        require(layer in document.layers, f"{name}: layer {layer} is not in the table")
    for layer in document.layers:
        kind = layer.dxf.linetype
        require(kind in document.linetypes, f"{name}: line type {kind} is not in the table")
        dashed = kind.upper() not in ("CONTINUOUS", "BYLAYER")
        require(dashed or layer.dxf.name not in CREASES, f"{name}: {layer.dxf.name} is not dashed")


def check_once(entities, name):
    """No cut line twice, whichever way it goes."""
    seen = set()
    for entity in (e for e in entities if e.dxf.layer in CUTS):
        for a, b in lines(entity):
            key = tuple(sorted(tuple(round(x, 4) for x in p) for p in (a, b)))
            require(key not in seen, f"{name}: the line {key} is cut twice")
            seen.add(key)


def check_file(path, version, pages):
    document = ezdxf.readfile(path)
    audit = document.audit()
    for problem in audit.errors + audit.fixes:
        faults.append(f"{path}: {problem.message}")
    require(document.dxfversion == version, f"{path}: version {document.dxfversion}")
    if version != "AC1009":
        require(document.units == MILLIMETRES, f"{path}: units {document.units}")
    entities = list(document.modelspace())
    check_layers(document, entities, path)
    check_once(entities, path)
    cuts = [e for e in entities if e.dxf.layer in CUTS]
    outlines = [e for e in cuts if e.dxf.layer == "CUT"]
    require(all(e.dxftype() in ("LWPOLYLINE", "POLYLINE") for e in outlines), f"{path}: an open contour")
    length = lambda layers: sum(math.dist(*s) for e in entities if e.dxf.layer in layers for s in lines(e))
    for key, layers in (("cut_mm", CUTS), ("crease_mm", CREASES)):
        expected = sum(page[key] for page in pages)
        found = length(layers)
        require(abs(found - expected) <= TOLERANCE_MM, f"{path}: {key} is {found}, reported {expected}")
    if len(pages) == 1:
        box = bbox.extents(outlines)
        found = [box.extmin.x, box.extmin.y, box.extmax.x, box.extmax.y]
        near = all(abs(a - b) <= TOLERANCE_MM for a, b in zip(found, pages[0]["bounds_mm"]))
        require(near, f"{path}: bounds {found}, reported {pages[0]['bounds_mm']}")


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        pages = json.load(file)["sheets"]["pages"]
    version, paths = sys.argv[2], sys.argv[3:]
    groups = [pages] if len(paths) == 1 else [[page] for page in pages]
    require(len(groups) == len(paths), f"{len(paths)} files for {len(pages)} sheets")
    for path, group in zip(paths, groups):
        check_file(path, version, group)
    for fault in faults[:20]:
        print(fault)
    if faults:
        sys.exit(f"{len(faults)} faults")
    print(f"{len(paths)} files: no error, nothing to mend, lengths as reported")


main()
