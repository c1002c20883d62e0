"""A build backend (PEP 517), with which ``pip install ./package`` accepts an ament_cmake package.

The package needs a ``pyproject.toml`` of three lines, since pip installs nothing without one::

    [build-system]
    requires = ["turtlewire-ros"]
    build-backend = "turtlewire_colcon.build_backend"

``python -m turtlewire_colcon.pip_install ./package`` does the same to a package without that file.
"""

from __future__ import annotations

import logging
import sys
import tarfile
from pathlib import Path
from typing import Any

from turtlewire_colcon.wheel import WheelError, build_package_wheels
from turtlewire_ros.manifest import ManifestError, read_manifest

__all__ = ["build_sdist", "build_wheel"]


def build_wheel(
    wheel_directory: str,
    config_settings: dict[str, Any] | None = None,  # noqa: ARG001 -- the names are PEP 517's
    metadata_directory: str | None = None,  # noqa: ARG001 -- likewise
) -> str:
    """Build the wheel of the package in the current folder; returns its file name.

    Ends the process with one line for each reason if the package cannot be installed.
    """
    try:
        (wheel,) = build_package_wheels([Path.cwd()], Path(wheel_directory), logging.warning)
    except WheelError as error:
        sys.exit(str(error))
    return wheel.name


def build_sdist(
    sdist_directory: str,
    config_settings: dict[str, Any] | None = None,  # noqa: ARG001 -- the name is PEP 517's
) -> str:
    """Pack the current folder; returns the archive's file name."""
    try:
        manifest = read_manifest(Path("package.xml"))
    except ManifestError as error:
        sys.exit(str(error))
    base = f"{manifest.name}-{manifest.version}"
    with tarfile.open(Path(sdist_directory) / f"{base}.tar.gz", "w:gz") as archive:
        for path in sorted(Path().iterdir()):
            if not path.name.startswith(".") and path.name not in ("build", "install", "log"):
                archive.add(path, f"{base}/{path.name}")
    return f"{base}.tar.gz"
