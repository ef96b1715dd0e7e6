"""The libraries that the program is made of, as a page of the book, or with the texts of their licences.

Usage: libraries.py          prints docs/reference/libraries.md
       libraries.py --texts  prints every licence text once, below the libraries that it is of
"""

import json
import pathlib
import subprocess
import sys

HEAD = """# Libraries and their licences

tatamu itself is free under [MIT](../../LICENSE-MIT) or [Apache 2.0](../../LICENSE-APACHE), at your
choice. It contains these libraries, some of them on some systems or in the studio alone:

| library | version | licence |
|---|---|---|"""


def cargo(*words):
    return subprocess.run(["cargo", *words], check=True, capture_output=True, text=True).stdout


def libraries():
    """Name, version, and licence of each crate that the program is linked with, on any system."""
    tree = cargo("tree", "-p", "tatamu", "-e", "normal,no-proc-macro", "--all-features", "--target", "all", "--locked",
                 "--prefix", "none", "--no-dedupe", "--format", "{p}|{l}")
    found = set()
    for line in tree.splitlines():
        package, licence = line.rsplit("|", 1)
        name, version = package.split()[:2]
        if not name.startswith("tatamu"):
            found.add((name, version.removeprefix("v"), " OR ".join(term.strip() for term in licence.split("/"))))
    return sorted(found)


def texts():
    """(text, names of the libraries that come with it), in the order of the names."""
    metadata = json.loads(cargo("metadata", "--format-version", "1", "--locked", "--all-features"))
    folders = {(p["name"], p["version"]): pathlib.Path(p["manifest_path"]).parent for p in metadata["packages"]}
    owners = {}
    for name, version, licence in libraries():
        files = [file for pattern in ("LICEN[CS]E*", "COPYING*", "NOTICE*", "COPYRIGHT*")
                 for file in sorted(folders[name, version].glob(pattern)) if file.is_file()]
        for file in files:
            owners.setdefault(file.read_text(errors="replace").strip(), []).append(f"{name} {version}")
        if not files:
            owners.setdefault(f"(no text comes with it; it is under {licence})", []).append(f"{name} {version}")
    return owners.items()


if "--texts" in sys.argv:
    for text, names in texts():
        print("-" * 80, ", ".join(dict.fromkeys(names)), "-" * 80, text, sep="\n", end="\n\n")
else:
    print(HEAD)
    for library in libraries():
        print("|", " | ".join(library), "|")
