"""Checks the contracts of .importlinter with the packages that are in this checkout."""

from __future__ import annotations

import configparser
import subprocess
import sys
from pathlib import Path

from distributions import ROOT, packages

OUTPUT = ROOT / "build" / "importlinter.ini"


def contracts() -> configparser.ConfigParser:
    """Return the contracts, with the packages of a shelf in place of its name.

    Raises:
        SystemExit: A shelf or a package beside the shelves has no layer.
    """
    found = configparser.ConfigParser()
    found.read(ROOT / ".importlinter", encoding="utf-8")
    shelves: dict[str, list[str]] = {}
    for package in packages():
        shelf = package if package.parent.name == "src" else package.parent
        shelves.setdefault(shelf.name, []).append(package.name)
    ros = found["importlinter:contract:ros"]
    layers = ros["layers"].split()
    if forgotten := {*shelves} - {*layers}:
        raise SystemExit(f".importlinter names no layer for {sorted(forgotten)}")
    here = [" : ".join(shelves[layer]) for layer in layers if layer in shelves]
    ros["layers"] = "\n".join(["", *here])
    names = "\n".join(["", *sorted(package.name for package in packages())])
    found["importlinter"] = {"root_packages": names}
    return found


def main() -> int:
    """Write the contracts and run import-linter; return the exit status."""
    OUTPUT.parent.mkdir(exist_ok=True)
    with OUTPUT.open("w", encoding="utf-8") as file:
        contracts().write(file)
    linter = Path(sys.executable).with_name("lint-imports")
    return subprocess.run([linter, "--config", OUTPUT], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
