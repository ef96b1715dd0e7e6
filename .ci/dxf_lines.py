"""The lines of a DXF file, by its pairs of codes and values alone."""


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


def height(path):
    """Height of the sheet: $EXTMAX."""
    found = pairs(path)
    return float(found[found.index(("9", "$EXTMAX")) + 2][1])
