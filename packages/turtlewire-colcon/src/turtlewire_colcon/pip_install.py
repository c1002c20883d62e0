"""``python -m turtlewire_colcon.pip_install PACKAGE…``: pip installs ament_cmake packages.

pip refuses folders without pyproject.toml and setup.py before it asks a build backend, and these
packages have neither. Packages that pip accepts are passed to it unchanged, so you can name all
packages of a workspace.
"""

from __future__ import annotations

import importlib.util
import subprocess
import sys
import tempfile
from pathlib import Path

from turtlewire.program import program
from turtlewire.terminal.parser import SuggestingParser
from turtlewire_colcon.wheel import WheelError, build_package_wheels

_OPTIONS = ["--no-deps", "--force-reinstall"]


def main(argv: list[str] | None = None) -> int:
    """Run the command line; returns the exit status."""
    parser = SuggestingParser(
        prog="python -m turtlewire_colcon.pip_install",
        description="Installs ament_cmake packages with Python, data and interfaces into this "
        "Python's environment. Each is built after its dependencies among them, and all "
        "are installed at the end. `pip uninstall NAME` removes them.",
    )
    parser.add_argument("packages", nargs="+", type=Path, metavar="PACKAGE", help="its folder")
    parser.add_argument("--output", type=Path, help="keep the wheels here, and install nothing")
    options = parser.parse_args(argv)
    if importlib.util.find_spec("pip") is None and not options.output:
        _say("this environment has no pip; with --output DIR the wheels are for another installer")
        return 1
    ours = [folder for folder in options.packages if not _is_for_pip(folder)]
    others = [str(folder.resolve()) for folder in options.packages if _is_for_pip(folder)]
    try:
        with tempfile.TemporaryDirectory() as folder:
            wheels = build_package_wheels(ours, options.output or Path(folder), _warn, _begin)
            if not options.output:
                return _pip("install", *_OPTIONS, *map(str, wheels), *others)
    except WheelError as error:
        _say(str(error))
        return 1
    for wheel in wheels:
        print(wheel, flush=True)  # noqa: T201 -- a command line prints, and before pip does
    if others:
        return _pip("wheel", "--no-deps", "--wheel-dir", str(options.output), *others)
    return 0


def _is_for_pip(folder: Path) -> bool:
    """Return True if pip installs a folder itself, such as an ament_python package."""
    return not (folder / "CMakeLists.txt").is_file() and any(
        (folder / name).is_file() for name in ("setup.py", "pyproject.toml")
    )


def _pip(*words: str) -> int:
    # The words are an action of pip, its options, and what the user named.
    command = [sys.executable, "-m", "pip", *words]
    return subprocess.run(command, check=False).returncode  # noqa: S603


def _begin(package: str) -> None:
    if sys.stderr.isatty():
        _say(f"Building the wheel of {package}")


def _warn(line: str) -> None:
    _say(f"warning: {line}")


def _say(text: str) -> None:
    print(text, file=sys.stderr)  # noqa: T201 -- a command line prints


if __name__ == "__main__":
    sys.exit(program(main)())
