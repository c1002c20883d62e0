"""``python -m turtlewire_ros.pip_install PACKAGE…``: pip installs ament_cmake packages.

pip itself refuses folders without pyproject.toml and setup.py, as such packages are.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

from turtlewire_ros.wheel import WheelError, build_package_wheel


def main(argv: list[str] | None = None) -> int:
    """Run the command line; returns the exit status."""
    parser = argparse.ArgumentParser(
        prog="python -m turtlewire_ros.pip_install",
        description="Installs ament_cmake packages of Python, data and interfaces into this "
        "Python's environment, in the given order. `pip uninstall NAME` removes them.",
    )
    parser.add_argument("packages", nargs="+", type=Path, metavar="PACKAGE", help="its folder")
    parser.add_argument("--output", type=Path, help="keep the wheels here, and install nothing")
    options = parser.parse_args(argv)
    try:
        with tempfile.TemporaryDirectory() as folder:
            for package in options.packages:
                wheel = build_package_wheel(package, options.output or Path(folder), _warn)
                if options.output:
                    print(wheel)  # noqa: T201 -- a command line prints
                elif status := _install(wheel):
                    return status
    except WheelError as error:
        print(error, file=sys.stderr)  # noqa: T201 -- as above
        return 1
    return 0


def _install(wheel: Path) -> int:
    command = [sys.executable, "-m", "pip", "install", "--no-deps", "--force-reinstall", str(wheel)]
    return subprocess.run(command, check=False).returncode  # noqa: S603 -- a wheel made above


def _warn(line: str) -> None:
    print(f"warning: {line}", file=sys.stderr)  # noqa: T201 -- a command line prints


if __name__ == "__main__":
    sys.exit(main())
