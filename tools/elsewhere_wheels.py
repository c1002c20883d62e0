"""Fills a venv for another Linux: installs wheels and their dependencies.

Usage: python elsewhere_wheels.py WHEELS VENV VERSION MACHINE [PACKAGE…], with `installer` and
`packaging`; the wheels in the folder WHEELS are ours, and downloads of pip are stored next to them.
"""

from __future__ import annotations

import subprocess
import sys
import zipfile
from email.parser import HeaderParser
from pathlib import Path

from installer import install
from installer.destinations import SchemeDictionaryDestination
from installer.sources import WheelFile
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name, parse_wheel_filename

#: The glibc versions that wheels on the package index name, from Debian 12's down.
GLIBC = (36, 35, 34, 31, 28, 27, 26, 24, 17)


def main(wheels: Path, venv: Path, version: str, machine: str, packages: list[str]) -> None:
    """Download what is missing, and install all wheels."""
    ours = sorted(wheels.glob("*.whl"))
    names = {parse_wheel_filename(path.name)[0] for path in ours}
    wanted = {
        f"{asked.name}{asked.specifier}"
        for path in ours
        for asked in requirements(path, version, machine)
        if canonicalize_name(asked.name) not in names
    }
    platforms = [f"--platform=manylinux_2_{minor}_{machine}" for minor in GLIBC]
    command = [sys.executable, "-m", "pip", "download", "-q", "-d", wheels]
    command += ["--only-binary=:all:", f"--python-version={version}", *platforms]
    command += [f"--platform=manylinux2014_{machine}", *sorted(wanted), *packages]
    subprocess.run(list(map(str, command)), check=True)
    modules = str(venv / "lib" / f"python{version}" / "site-packages")
    scheme = {"purelib": modules, "platlib": modules, "headers": str(venv / "include")}
    scheme |= {"scripts": str(venv / "bin"), "data": str(venv)}
    destination = SchemeDictionaryDestination(
        scheme, interpreter=str(venv / "bin" / "python"), script_kind="posix"
    )
    for path in sorted(wheels.glob("*.whl")):
        with WheelFile.open(path) as source:
            install(source, destination, {"INSTALLER": b"scripts/elsewhere"})


def requirements(wheel: Path, version: str, machine: str) -> list[Requirement]:
    """Return a wheel's requirements on Linux with CPython."""
    there = {"platform_machine": machine, "sys_platform": "linux", "extra": ""}
    there |= {"python_version": version, "implementation_name": "cpython"}
    with zipfile.ZipFile(wheel) as archive:
        [name] = [name for name in archive.namelist() if name.endswith(".dist-info/METADATA")]
        text = archive.read(name).decode()
    asked = map(Requirement, HeaderParser().parsestr(text).get_all("Requires-Dist", []))
    return [each for each in asked if each.marker is None or each.marker.evaluate(there)]


if __name__ == "__main__":
    _, wheels, venv, version, machine, *packages = sys.argv
    main(Path(wheels), Path(venv), version, machine, packages)
