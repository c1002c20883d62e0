"""What scripts/setup does, with a bare python3: without venv package, pip or compiler."""

from __future__ import annotations

import argparse
import fcntl
import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import sysconfig
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

if TYPE_CHECKING:
    from collections.abc import Sequence

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
PYTHON = VENV / "bin" / "python"
STAMP = VENV / "turtlewire-stamp.json"
LEARNING = ROOT / "ros2_ws" / "src" / "learning_tf2_py"
CLASSROOM = ROOT / "classroom"
#: The releases that CI installs, with their hashes.
LOCK = ROOT / "scripts" / "locks" / "ci.txt"

#: The signals that end the set-up.
ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
#: pip that installs dependency groups of a pyproject.toml.
OLDEST_PIP = (25, 1)
#: What can be added: dependency groups of pyproject.toml, and an extra of turtlewire-ros.
EXTRAS = {"test": "what the tests need", "lint": "ruff, mypy …", "workspace": "colcon and rosdep"}
#: What pip prints when it cannot reach the package index.
NO_NETWORK = re.compile(
    r"NewConnectionError|NameResolutionError|ConnectTimeoutError|Max retries exceeded|ProxyError"
)


#: Prints the middleware and its library.
MIDDLEWARE = """
from turtlewire.wire.environment import is_installed, middleware_library, middleware_name
name = middleware_name()
if is_installed(name):
    print(f"{name} stands on {middleware_library(name)}")
"""


class SetupError(Exception):
    """An error whose text names in one sentence what is missing."""


def main(extras: list[str]) -> None:
    """Bring .venv up to date with the sources, with ``extras`` installed besides."""
    if sys.version_info < (3, 10):  # noqa: UP036 -- whatever python3 is on the machine runs this
        raise SetupError(
            f"{sys.executable} is Python {sys.version.split()[0]}; 3.10 or newer is needed "
            "(PYTHON=python3.12 names another)"
        )
    if not missing(extras)[1]:
        return
    lock = wait_for_turn()
    try:
        stamp, wanted = missing(extras)
        if wanted:
            bring_up_to_date(stamp, wanted)
    finally:
        os.close(lock)


def parse_extras(arguments: list[str]) -> list[str]:
    """The extras named on the command line; ends the program when there is no such extra."""
    described = "; ".join(f"{name}: {text}" for name, text in EXTRAS.items())
    parser = argparse.ArgumentParser(
        prog="scripts/setup",
        description="Makes .venv in this folder or brings it up to date, and installs everything "
        "into it, editable. Outside of this folder it writes only what pip keeps in its cache.",
    )
    parser.add_argument("extras", nargs="*", metavar="EXTRA", help=described)
    extras: list[str] = parser.parse_args(arguments).extras
    for unknown in sorted({*extras} - {*EXTRAS}):
        parser.error(f"there is no extra {unknown!r}; choose from {', '.join(EXTRAS)}")
    return extras


def missing(extras: list[str]) -> tuple[dict[str, Any], dict[str, Any]]:
    """The last installation, and the wanted one, which is empty when nothing has changed."""
    stamp = read_stamp()
    wanted = {
        "python": f"{sys.version} in {ROOT}",
        "sources": fingerprint(),
        "extras": sorted({*stamp.get("extras", []), *extras}),
    }
    return stamp, {} if stamp == wanted else wanted


def wait_for_turn() -> int:
    """Lock this folder against a second set-up; returns the descriptor that holds the lock."""
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
        say("making .venv here and downloading about 55 packages, which takes about a minute")
        make_venv()
    else:
        say("bringing .venv up to date with the sources")
    ensure_pip()
    install(wanted["extras"], only_extras=only_extras)
    STAMP.write_text(json.dumps(wanted), encoding="utf-8")
    say(f"ready after {time.monotonic() - started:.0f} s; {middleware()}")


def middleware() -> str:
    """The middleware that .venv has, what it stands on and why."""
    done = run_python("-c", MIDDLEWARE)
    return done.stdout.strip() or "no middleware: only the transform buffer works here"


def usable(stamp: dict[str, Any], wanted: dict[str, Any]) -> bool:
    """Whether there is a .venv that works, of this Python, and that was not moved here."""
    return (
        stamp.get("python", wanted["python"]) == wanted["python"]
        and PYTHON.exists()
        and run_python("-c", "").returncode == 0
    )


def say(text: str) -> None:
    """Print a line for the user."""
    print(f"[setup] {text}", file=sys.stderr, flush=True)


def read_stamp() -> dict[str, Any]:
    """What was installed last; nothing when .venv is missing or was not set up by this."""
    try:
        stamp: dict[str, Any] = json.loads(STAMP.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return stamp


def fingerprint() -> str:
    """Hash of the files, and the compiler, whose changes need a new installation."""
    ros, native = ROOT / "ros", ROOT / "native"
    files = [
        ROOT / "pyproject.toml",
        native / "CMakeLists.txt",
        *LEARNING.glob("setup.*"),
        LEARNING / "package.xml",
        CLASSROOM / "pyproject.toml",
    ]
    files += [*ros.glob("*.*"), *ros.glob("turtlewire_ros/*/*.*"), *ros.glob("*/share/**/*")]
    files += [*(ROOT / "src" / "turtlewire" / "msg" / "interfaces").glob("*/*/*.*")]
    files += [path for path in native.glob("*/*.?pp") if path.parent.name != "tests"]
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
    """Put a pip that is new enough into .venv: the bundled one, or by means of this Python's."""
    if pip_version() is None:
        run_python("-m", "ensurepip")
    if (version := pip_version()) is not None:
        if version < OLDEST_PIP:
            pip("install", f"pip>={OLDEST_PIP[0]}.{OLDEST_PIP[1]}")
        return
    outer = subprocess.run(
        [sys.executable, "-m", "pip", "--version"], capture_output=True, text=True, check=False
    )
    if outer.returncode == 0 and version_of(outer.stdout) >= (22, 3):
        checked([sys.executable, "-m", "pip", "--python", str(PYTHON), "install", "-q", "pip"])
        return
    raise SetupError(
        "this Python has no pip of 22.3 or newer; install it (Debian: `apt install python3-pip`) "
        "and try again"
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
    """Install the four packages editable, unless they are there, and the extras."""
    workspace = "[workspace]" if "workspace" in extras else ""
    groups = [
        argument
        for name in extras
        if name != "workspace"
        for argument in ("--group", f"{ROOT / 'pyproject.toml'}:{name}")
    ]
    if os.environ.get("CI") == "true":  # what follows finds all but our own packages installed
        pip("install", "--require-hashes", "-r", str(LOCK))
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
            "-e",
            str(CLASSROOM),
            *groups,
        )
        clear_build_files()


def clear_build_files() -> None:
    """Remove what CMake wrote beside the C++ sources.

    scikit-build-core builds an editable installation in the source folder; each build starts anew.
    """
    made = (".cmake", ".ninja_*", ".skbuild-*", "CMake*", "cmake_install.cmake", "*.ninja", "*.a")
    for pattern in made:
        for path in (ROOT / "native").glob(pattern):
            if path.is_dir():
                shutil.rmtree(path)
            elif path.name != "CMakeLists.txt":
                path.unlink()


def pip(*arguments: str) -> None:
    """Run the venv's pip."""
    command = [str(PYTHON), "-m", "pip", "--disable-pip-version-check", "--no-input", "-q"]
    checked([*command, *arguments])


def checked(command: list[str]) -> None:
    """Run a command whose failure ends the set-up, and show what it printed if it fails."""
    # setuptools warns at length about every editable installation
    environment = {**clean_environment(), "PYTHONWARNINGS": "ignore::UserWarning"}
    started = time.monotonic()
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as output:
        # In a session of its own: Ctrl-C reaches only this program, which stops the whole group.
        with subprocess.Popen(
            command,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        ) as process:
            try:
                while not ended_within(process, 1.0):
                    show_progress(f"[setup] {time.monotonic() - started:.0f} s ")
            except BaseException:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
                raise
            finally:
                show_progress("")
        if process.returncode:
            output.seek(0)
            fail(command, output.read())


def fail(command: list[str], output: str) -> NoReturn:
    """Raise the error that says why a command failed."""
    if NO_NETWORK.search(output):
        raise SetupError(
            "no network: the package index cannot be reached; connect, then type the same again"
        )
    sys.stderr.write(output)
    raise SetupError(f"this failed, see above: {' '.join(command)}")


def ended_within(process: subprocess.Popen[bytes], seconds: float) -> bool:
    """Wait for the end of a process; False if it still runs after that time."""
    try:
        process.wait(seconds)
    except subprocess.TimeoutExpired:
        return False
    return True


def show_progress(text: str) -> None:
    """Replace the progress line, if the output is a terminal."""
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)


def interrupt(_signum: int, _frame: object) -> NoReturn:
    """End as after Ctrl-C; a second signal, which a terminal sends too, is ignored."""
    for signum in ENDING:
        signal.signal(signum, lambda _signum, _frame: None)
    raise KeyboardInterrupt


def run(arguments: list[str]) -> int:
    """Set up, and say in one line what went wrong; the exit status."""
    for signum in ENDING:
        signal.signal(signum, interrupt)
    try:
        main(parse_extras(arguments))
    except SetupError as error:
        say(str(error))
        return 1
    except KeyboardInterrupt:
        say("interrupted; the next run goes on")
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(run(sys.argv[1:]))
