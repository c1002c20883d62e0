"""What the page loads at its start."""

from __future__ import annotations

import hashlib
import posixpath
import re
from importlib.resources import files
from pathlib import Path

PAGE = Path(str(files("turtlewire_view") / "page"))
KIT = Path(str(files("turtlewire.web") / "kit"))
IMPORT = re.compile(r"^import\b[^;]*?from\s*\"([^\"]+)\"|\bfrom\"(\./[^\"]+)\"", re.MULTILINE)
THREE = "vendor/three-0.185.1/"


def imported(name: str) -> set[str]:
    """What a module imports, as paths from the page."""
    file = KIT.parent / name if name.startswith("kit/") else PAGE / name
    names = [a or b for a, b in IMPORT.findall(file.read_text("utf-8"))]
    known = {"three": THREE + "three.module.min.js"}
    return {
        known.get(each)
        or (
            each.replace("three/", THREE, 1)
            if each.startswith("three/addons/")
            else posixpath.normpath(posixpath.join(posixpath.dirname(name), each))
        )
        for each in names
    }


def test_the_page_names_all_its_modules_beforehand():
    found, waiting = set(), ["js/main.js"]
    while waiting:
        name = waiting.pop()
        new = imported(name) - found
        found |= new
        waiting += new
    links = re.findall(
        r'rel="modulepreload" href="([^"]+)"', (PAGE / "index.html").read_text("utf-8")
    )
    assert sorted(links) == sorted(found), "change the links in page/index.html"


# The vendored three.js is what npm's package holds, byte for byte, and nothing else.


VENDOR = files("turtlewire_view") / "page" / "vendor" / "three-0.185.1"
OURS = {"VENDOR.md", "SHA256SUMS"}


def found(folder, above: str = "") -> dict[str, bytes]:
    """Path to content of every file below a folder."""
    contents = {}
    for entry in folder.iterdir():
        name = f"{above}{entry.name}"
        contents |= found(entry, f"{name}/") if entry.is_dir() else {name: entry.read_bytes()}
    return contents


def test_files_are_those_of_the_package():
    listed = dict(
        reversed(line.split("  ./"))
        for line in (VENDOR / "SHA256SUMS").read_text(encoding="utf-8").splitlines()
    )
    contents = found(VENDOR)
    sums = {
        path: hashlib.sha256(content).hexdigest()
        for path, content in contents.items()
        if path not in OURS
    }
    assert sums == listed


def test_name_and_licence_are_printed():
    contents = found(VENDOR)
    assert b"sha512-5aojFCXKwnjBRZvUnt3WFfEcvUJgkN5LlijRFN95hMy8" in contents["VENDOR.md"]
    assert b"MIT License" in contents["LICENSE"]
    assert b"REVISION" in contents["three.module.min.js"]
