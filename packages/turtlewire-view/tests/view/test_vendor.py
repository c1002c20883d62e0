"""The vendored three.js is what npm's package holds, byte for byte, and nothing else."""

from __future__ import annotations

import hashlib
from importlib.resources import files

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
