"""A workspace with data packages, built as typed."""

from __future__ import annotations

import importlib.util
import os
import subprocess
from pathlib import Path

import pytest
from tests.places import BIN, PATH

from tests import archive

#: The packages of the URDF tutorials.
PACKAGES = Path(__file__).parent / "urdf_packages.txt"


@pytest.fixture(scope="session")
def workspace(tmp_path_factory):
    """The packages of the URDF tutorials, built by colcon; `install` is in this folder."""
    if importlib.util.find_spec("colcon_ros") is None:
        pytest.skip("needs colcon: pip install 'turtlewire-colcon[workspace]'")
    folder = tmp_path_factory.mktemp("urdf")
    archive.unpack(PACKAGES, folder / "src")
    done = subprocess.run(
        [
            BIN / "colcon",
            "--log-base",
            folder / "log",
            "build",
            "--event-handlers",
            "console_direct+",
        ],
        cwd=folder,
        env=os.environ | {"PATH": PATH},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


@pytest.fixture
def sourced(workspace):
    """Runs a line in a shell that has sourced the workspace."""

    def line(command: str) -> list[str]:
        setup = f". {workspace}/install/local_setup.bash"
        return ["bash", "-c", f"export PATH={BIN}:$PATH; {setup} && exec {command}"]

    return line
