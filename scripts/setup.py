"""What scripts/setup does, with nothing but a bare python3: no venv package, no pip, no compiler is taken for granted."""

from __future__ import annotations

import fcntl
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
PYTHON = VENV / "bin" / "python"
STAMP = VENV / "turtlewire-stamp.json"
LEARNING = ROOT / "ros2_ws" / "src" / "learning_tf2_py"

#: pip that installs dependency groups of a pyproject.toml.
OLDEST_PIP = (25, 1)


class SetupError(Exception):
    """Says in one sentence what is missing."""


def main(extras: list[str]) -> None:
    """Bring .venv up to date with the sources, with ``extras`` installed besides."""
    if sys.version_info < (3, 10):  # noqa: UP036 -- whatever python3 is on the machine runs this
        raise SetupError(
            f"{sys.executable} is Python {sys.version.split()[0]}; 3.10 or newer is needed (PYTHON=python3.12 names another)"
        )
    if not missing(extras)[1]:
        return
    lock = wait_for_turn()
    stamp, wanted = missing(extras)
    if wanted:
        bring_up_to_date(stamp, wanted)
    os.close(lock)


def missing(extras: list[str]) -> tuple[dict[str, Any], dict[str, Any]]:
    """What was installed last, and what is to be installed instead; nothing when all is there."""
    stamp = read_stamp()
    wanted = {
        "python": f"{sys.version} in {ROOT}",
        "sources": fingerprint(),
        "extras": sorted({*stamp.get("extras", []), *extras}),
    }
    return stamp, {} if stamp == wanted else wanted


def wait_for_turn() -> int:
    """Lock this folder, so that two terminals do not set up .venv at once; the descriptor that holds the lock."""
    descriptor = os.open(ROOT, os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        say("another terminal is setting up .venv: waiting for it")
        fcntl.flock(descriptor, fcntl.LOCK_EX)
    return descriptor


def bring_up_to_date(stamp: dict[str, Any], wanted: dict[str, Any]) -> None:
    """Make .venv, or what of it is stale, and note what it holds then."""
    started = time.monotonic()
    venv_works = usable(stamp, wanted)
    only_extras = venv_works and stamp.get("sources") == wanted["sources"]
    if only_extras:
        say(f"adding to .venv: {', '.join(sorted({*wanted['extras']} - {*stamp['extras']}))}")
    elif not venv_works:
        say(
            "making .venv here and downloading what it needs (about 55 packages, under a minute); nothing else is touched"
        )
        make_venv()
    else:
        say("bringing .venv up to date with the sources")
    ensure_pip()
    install(wanted["extras"], only_extras=only_extras)
    STAMP.write_text(json.dumps(wanted), encoding="utf-8")
    say(f"ready after {time.monotonic() - started:.0f} s")


def usable(stamp: dict[str, Any], wanted: dict[str, Any]) -> bool:
    """Whether there is a .venv that works, of this Python, and that was not moved here."""
    return (
        stamp.get("python", wanted["python"]) == wanted["python"]
        and PYTHON.exists()
        and run_python("-c", "").returncode == 0
    )


def say(text: str) -> None:
    """Tell the person in front of it."""
    print(f"[setup] {text}", file=sys.stderr, flush=True)


def read_stamp() -> dict[str, Any]:
    """What was installed last; nothing when .venv is missing or was not set up by this."""
    try:
        stamp: dict[str, Any] = json.loads(STAMP.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return stamp


def fingerprint() -> str:
    """Hash of all that an editable installation does not follow by itself, the tools to compile with included."""
    ros, native = ROOT / "ros", ROOT / "native"
    files = [
        ROOT / "pyproject.toml",
        native / "CMakeLists.txt",
        *LEARNING.glob("setup.*"),
        LEARNING / "package.xml",
    ]
    files += [*ros.glob("*.*"), *ros.glob("turtlewire_ros/*/*.*"), *ros.glob("*/share/**/*")]
    files += [path for folder in ("core", "bindings") for path in (native / folder).glob("*.?pp")]
    inits = [*ros.glob("*/__init__.py"), *ros.glob("interfaces/*/__init__.py")]
    packages = sorted(path.parent.name for path in inits)
    digest = hashlib.sha256(f"{can_compile()} {packages}".encode())
    for path in sorted(files):
        if path.is_file() and "__pycache__" not in path.parts:
            digest.update(str(path.relative_to(ROOT)).encode())
            digest.update(path.read_bytes())
    return digest.hexdigest()


def can_compile() -> bool:
    """Whether a C++ compiler and Python's headers are there."""
    headers = Path(sysconfig.get_path("include")) / "Python.h"
    return headers.exists() and any(
        shutil.which(name) for name in (os.environ.get("CXX", "c++"), "c++", "g++", "clang++")
    )


def run_python(*arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the venv's Python quietly."""
    return subprocess.run(
        [str(PYTHON), *arguments],
        capture_output=True,
        text=True,
        check=False,
        env=clean_environment(),
    )


def clean_environment() -> dict[str, str]:
    """The environment without what a sourced ROS 2 would mix in."""
    return {
        name: value
        for name, value in os.environ.items()
        if name not in {"PYTHONPATH", "PYTHONHOME", "AMENT_PREFIX_PATH"}
    }


def make_venv() -> None:
    """Make .venv without pip, which even a Debian without python3-venv can do."""
    # Inside of a venv, and this may be run with .venv's own Python, the one that it was made from.
    base: str = vars(sys)["_base_executable"]
    command = [base, "-m", "venv", "--without-pip", "--clear", str(VENV)]
    done = subprocess.run(
        command, capture_output=True, text=True, check=False, env=clean_environment()
    )
    if done.returncode:
        raise SetupError(f"could not make .venv:\n{done.stdout}{done.stderr}")


def ensure_pip() -> None:
    """Get a pip that is new enough into .venv: the one bundled with Python, or the one that this Python has."""
    if pip_version() is None:
        run_python("-m", "ensurepip")
    if (version := pip_version()) is not None:
        if version < OLDEST_PIP:
            pip("install", "--upgrade", "pip")
        return
    outer = subprocess.run(
        [sys.executable, "-m", "pip", "--version"], capture_output=True, text=True, check=False
    )
    if outer.returncode == 0 and version_of(outer.stdout) >= (22, 3):
        checked([sys.executable, "-m", "pip", "--python", str(PYTHON), "install", "-q", "pip"])
        return
    raise SetupError(
        "this Python has no pip of 22.3 or newer; install it (Debian: `apt install python3-pip`) and try again"
    )


def pip_version() -> tuple[int, ...] | None:
    """Version of the venv's pip; None when there is none."""
    done = run_python("-m", "pip", "--version")
    return version_of(done.stdout) if done.returncode == 0 else None


def version_of(text: str) -> tuple[int, ...]:
    """The first two numbers of ``pip 25.1.1 from …``."""
    numbers = re.search(r"(\d+)\.(\d+)", text)
    return (int(numbers[1]), int(numbers[2])) if numbers else (0, 0)


def install(extras: Sequence[str], *, only_extras: bool) -> None:
    """Install the three packages editable, unless they are there, and the extras."""
    workspace = "[workspace]" if "workspace" in extras else ""
    groups = [
        argument
        for name in extras
        if name != "workspace"
        for argument in ("--group", f"{ROOT / 'pyproject.toml'}:{name}")
    ]
    if only_extras:  # compiling takes most of the time
        pip("install", f"turtlewire-ros{workspace}", *groups)
    else:
        pip(
            "install",
            "-e",
            str(ROOT),
            "-e",
            f"{ROOT / 'ros'}{workspace}",
            "-e",
            str(LEARNING),
            *groups,
        )


def pip(*arguments: str) -> None:
    """Run the venv's pip."""
    checked([str(PYTHON), "-m", "pip", "--disable-pip-version-check", "-q", *arguments])


def checked(command: list[str]) -> None:
    """Run a command whose failure ends the setup."""
    # setuptools warns at length about every editable installation
    environment = {**clean_environment(), "PYTHONWARNINGS": "ignore::UserWarning"}
    started = time.monotonic()
    with subprocess.Popen(command, env=environment, stdout=sys.stderr) as process:
        try:
            while not ended_within(process, 1.0):
                show_progress(f"[setup] {time.monotonic() - started:.0f} s ")
        except BaseException:
            process.kill()
            raise
    show_progress("")
    if process.returncode:
        raise SetupError(f"this failed, see above: {' '.join(command)}")


def ended_within(process: subprocess.Popen[bytes], seconds: float) -> bool:
    """Wait for its end; False when it goes on after that time."""
    try:
        process.wait(seconds)
    except subprocess.TimeoutExpired:
        return False
    return True


def show_progress(text: str) -> None:
    """Show a person at a terminal that it goes on, in place of the text before."""
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except SetupError as error:
        sys.exit(f"[setup] {error}")
    except KeyboardInterrupt:
        say("interrupted; the next run goes on")
        sys.exit(130)
