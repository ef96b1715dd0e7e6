"""Pages rendered to grey images: there are as many as there should be, and each has marks.

Usage: check_ink.py COUNT PAGE.pgm...
"""

import sys

# A scale bar alone has more dark pixels than this share.
LEAST_SHARE = 2e-4


def dark_share(path):
    with open(path, "rb") as file:
        data = file.read()
    fields = data.split(maxsplit=4)
    if fields[0] != b"P5" or fields[3] != b"255":
        sys.exit(f"{path}: not an 8-bit grey image")
    count = int(fields[1]) * int(fields[2])
    pixels = data[len(data) - count :]
    return sum(1 for pixel in pixels if pixel < 200) / count


def main():
    expected, paths = int(sys.argv[1]), sys.argv[2:]
    if len(paths) != expected or expected < 1:
        sys.exit(f"{len(paths)} images for {expected} pages")
    for path in paths:
        share = dark_share(path)
        if share < LEAST_SHARE:
            sys.exit(f"{path}: only {share:.6f} of the page is marked")


main()
