"""The implementation of scripts/free-threaded: the tests of the buffer without a GIL."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from distributions import ENGINE, ROS
from release_wheels import ROOT, ReleaseError, install_locked, run, say
from script_options import ScriptParser

HOME = ROOT / "build" / "free-threaded"
#: What packages and tests need that has wheels of free-threaded Pythons, or is plain Python.
NEEDS = (
    *("numpy", "PyYAML", "argcomplete", "websockets", "segno"),
    *("pytest", "pytest-timeout", "pytest-xdist", "hypothesis", "scipy", "transforms3d"),
)
TESTS = ("packages/turtlewire/tests/tf", "packages/turtlewire-ros/geometry2/tests/tf2_py")
ABOUT = "import sys, sysconfig; print(sys.version.split()[0], sysconfig.get_config_var('SOABI'))"


def version_of(python: str) -> str:
    """Return the version of a Python, such as ``3.14.0t``.

    Raises:
        ReleaseError: The Python cannot be started, or has a GIL.
    """
    try:
        done = subprocess.run([python, "-c", ABOUT], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise ReleaseError(f"{python} is no Python that starts: {error}") from None
    version, abi = done.stdout.split()
    if not abi.split("-")[1].endswith("t"):
        raise ReleaseError(f"{python} is not free-threaded; name one such as python3.14t")
    return f"{version}t"


def make_venv(python: str) -> Path:
    """Make a venv with the packages and what tests them, or bring it up to date."""
    version = version_of(python)
    venv = HOME / version
    own = venv / "bin" / "python"
    if not own.exists():
        run(python, "-m", "venv", "--clear", venv, what=f"a venv of Python {version}")
    install_locked(own, "build", what="what compiles the core")
    command = [own, "-m", "pip", "install", "-q"]
    # The newest releases may have no wheels for it, and compiling NumPy takes half an hour.
    run(*command, "--prefer-binary", *NEEDS, what="what the tests need")
    # Not editable: such a build of the core would write into the folder of its sources.
    command += ["--no-deps", "--no-build-isolation", "-C", f"build-dir={venv}/core", ENGINE, ROS]
    environment = {**os.environ, "PATH": f"{own.parent}{os.pathsep}{os.environ['PATH']}"}
    run(*command, what="our packages", environment=environment)
    return own


def main() -> int:
    """Run the tests; returns their exit status."""
    parser = ScriptParser(
        prog="scripts/free-threaded",
        description="Runs the tests of the buffer with a Python that has no GIL.",
        epilog="Other arguments go to pytest, instead of the tests of the buffer.",
    )
    parser.add_argument("python", metavar="PYTHON", help="its command, such as python3.14t")
    options, words = parser.parse_known_args()
    try:
        python = make_venv(options.python)
    except ReleaseError as error:
        say(str(error))
        return 1
    # No middleware has wheels for it; the tests that run on both would miss Zenoh.
    words = words or ["-n", "2", "-m", "not slow", "-k", "not rmw_zenoh_cpp", *TESTS]
    environment = {**os.environ, "TURTLEWIRE_REQUIRE_NATIVE": "1"}
    command = [str(python), "-m", "pytest", *words]
    return subprocess.run(command, cwd=ROOT, env=environment, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
