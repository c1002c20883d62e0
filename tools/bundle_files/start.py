"""Installs turtlewire from the wheels next to this file, without a network, and runs the demo.

It needs nothing but a Python for which the folder has wheels: no pip, no venv package of Debian.
"""

from __future__ import annotations

import argparse
import platform
import re
import shlex
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
WHEELS = HERE / "wheels"
#: Not on the stick: its file system may have no links, and programs there start slowly.
DEFAULT = Path.home() / "turtlewire-class"


def main() -> int:
    """Install unless it is done, run the demo; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], allow_abbrev=False)
    parser.add_argument(
        "--into", type=Path, default=DEFAULT, metavar="FOLDER", help=f"default: {DEFAULT}"
    )
    parser.add_argument("--install-only", action="store_true", help="do not run the demo")
    parser.add_argument("--seconds", type=float, help="stop the demo after this many")
    arguments = parser.parse_args()
    venv = arguments.into.absolute()
    commands = venv / ("Scripts" if sys.platform == "win32" else "bin")
    python = commands / ("python.exe" if sys.platform == "win32" else "python")
    done = venv / "installed"
    wanted = "\n".join(sorted(path.name for path in WHEELS.glob("*.whl")))
    if not done.exists() or done.read_text(encoding="utf-8") != wanted:
        if message := unfit():
            print(message, file=sys.stderr)
            return 1
        print(f"Installing into {venv} (once; it takes about a minute) …", flush=True)
        status = install(venv, python)
        if status:
            return status
        done.write_text(wanted, encoding="utf-8")
    activate = f". {shlex.quote(str(commands / 'activate'))}"
    if sys.platform == "win32":
        activate = str(commands / "Activate.ps1")
    print(f"In other terminals, type first:  {activate}")
    print(f"Exercises and documents are in {HERE}.", flush=True)
    if arguments.install_only:
        return 0
    demo = [str(python), "-m", "turtlewire.demo"]
    demo += [] if arguments.seconds is None else ["--seconds", str(arguments.seconds)]
    try:
        return subprocess.run(demo, check=False).returncode
    except KeyboardInterrupt:
        return 130


def unfit() -> str:
    """Return why the wheels do not fit this Python or system; empty if they do."""
    pattern = re.compile(r"-cp3(\d+)-(\w+)-([\w.]+)\.whl$")
    names = [pattern.search(path.name) for path in WHEELS.glob("turtlewire-*.whl")]
    found = [(int(name[1]), name[2], name[3]) for name in names if name]
    minor = sys.version_info[1]
    system = {"darwin": "macos", "win32": "win"}.get(sys.platform, sys.platform)
    machine = platform.machine().lower()
    for version, abi, tag in found:
        fits = version == minor or (abi == "abi3" and version < minor)
        if fits and system in tag and machine in tag:
            return ""
    have = ", ".join(sorted(f"Python 3.{version} on {tag}" for version, _, tag in found))
    return (
        f"This is Python 3.{minor} on {system} ({machine}). "
        f"The folder has wheels for: {have}.\nUse another Python (PYTHON=python3.12 ./start), or "
        "make a bundle on such a computer: scripts/bundle."
    )


def install(venv: Path, python: Path) -> int:
    """Make the venv and install; the exit status. pip runs out of its own wheel."""
    status = subprocess.run(
        [sys.executable, "-m", "venv", "--clear", "--without-pip", str(venv)], check=False
    ).returncode
    if status:
        return status
    [pip] = WHEELS.glob("pip-*.whl")
    offline = ["--no-index", "--find-links", str(WHEELS), "--disable-pip-version-check", "-q"]
    command = [str(python), str(pip / "pip"), "install", *offline, "pip", "turtlewire-class"]
    return subprocess.run(command, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
