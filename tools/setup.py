"""The implementation of scripts/setup for a bare python3, without venv package, pip or compiler."""

import sys

if sys.version_info < (3, 10):  # noqa: UP036 -- whatever python3 is on the machine runs this
    sys.exit(
        f"[setup] {sys.executable} is Python {sys.version.split()[0]}; 3.10 or newer is needed "
        "(PYTHON=python3.12 names another)"
    )

import fcntl
import hashlib
import json
import os
import signal
import time
from pathlib import Path
from typing import Any, NoReturn

sys.path.insert(0, str(Path(__file__).resolve().parent))

from distributions import ENGINE, LEARNING, ROOT, ROS, distributions, packages
from script_options import ScriptParser
from setup_core import CORE, core_key, provide_core
from setup_steps import PYTHON, VENV, SetupError, run_python, say, stage
from setup_venv import install, make_venv, pip_command, pip_version

STAMP = VENV / "turtlewire-stamp.json"
#: The signals that end the set-up.
ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
#: What can be added: dependency groups of pyproject.toml, and an extra of turtlewire-colcon.
EXTRAS = {"test": "what the tests need", "lint": "ruff and mypy", "workspace": "colcon and rosdep"}
#: Prints the middleware, and its library if that is not the usual one, or why it is Zenoh.
MIDDLEWARE = """
from turtlewire.wire import environment
from turtlewire.wire.environment import is_installed
name = environment.middleware_name()
library = environment.middleware_library(name)
reason = "" if "the cyclonedds wheel" in library else f", which uses {library}"
if not is_installed("rmw_cyclonedds_cpp"):
    reason = f". {environment.NO_CYCLONE}"
print(f"middleware {name}{reason}" if is_installed(name) else "only the transform buffer")
"""


def main(extras: list[str]) -> None:
    """Bring .venv up to date with the sources, with ``extras`` installed besides."""
    if not missing(extras)[1]:
        say("nothing to do: .venv is up to date")
        return
    lock = wait_for_turn(ROOT)
    try:
        stamp, wanted = missing(extras)
        if wanted:
            bring_up_to_date(stamp, wanted)
    finally:
        os.close(lock)


def parse_extras(arguments: list[str]) -> list[str]:
    """Return the extras named on the command line; end the program at an unknown one."""
    described = "; ".join(f"{name}: {text}" for name, text in EXTRAS.items())
    parser = ScriptParser(
        prog="scripts/setup",
        description="Makes .venv in this folder or brings it up to date, and installs everything "
        "into it, editable. Outside of this folder it writes only caches: what pip or uv keeps, "
        "and the compiled core in ~/.cache/turtlewire.",
    )
    parser.add_argument("extras", nargs="*", metavar="EXTRA", help=described)
    extras: list[str] = parser.parse_args(arguments).extras
    for unknown in sorted({*extras} - {*EXTRAS}):
        parser.error(f"there is no extra {unknown!r}; choose from {', '.join(EXTRAS)}")
    return extras


def missing(extras: list[str]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the last installation, and the wanted one, which is empty if nothing has changed."""
    stamp = read_stamp()
    wanted = {
        "python": f"{sys.version} in {ROOT}",
        "distributions": [folder.name for folder in distributions()],
        "sources": fingerprint(),
        "core": core_key(),
        "extras": sorted({*stamp.get("extras", []), *extras}),
    }
    if stamp.pop("has_core", False) and not CORE.exists():  # deleted by hand
        stamp.pop("core", None)
    return stamp, {} if stamp == wanted else wanted


def wait_for_turn(folder: Path) -> int:
    """Lock a checkout against a second set-up; return the descriptor that holds the lock."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        say("another terminal is setting up .venv: waiting for it")
        fcntl.flock(descriptor, fcntl.LOCK_EX)
    return descriptor


def bring_up_to_date(stamp: dict[str, Any], wanted: dict[str, Any]) -> None:
    """Create .venv or update its stale parts, and record its contents."""
    started = time.monotonic()
    venv_works = usable(stamp, wanted)
    if not venv_works:
        stamp = {}
        put_pip = pip_command()
        with stage(f"making .venv with Python {sys.version.split()[0]}"):
            make_venv(put_pip)
    only_extras = stamp.get("sources") == wanted["sources"]
    if not only_extras:
        size = "" if venv_works else " (35 MB to download, 485 with those of the tests)"
        with stage(f"installing the packages{size}"):
            install(wanted["extras"], only_extras=False)
    elif stamp["extras"] != wanted["extras"]:
        added = sorted({*wanted["extras"]} - {*stamp["extras"]})
        with stage(f"adding the packages for {', '.join(added)}"):
            install(wanted["extras"], only_extras=True)
    if stamp.get("core") != wanted["core"]:
        # An interrupted run continues from here.
        STAMP.write_text(json.dumps({**wanted, "core": None}), encoding="utf-8")
        provide_core(wanted["core"])
    noted = {**wanted, "has_core": CORE.exists()}
    STAMP.write_text(json.dumps(noted), encoding="utf-8")
    say(f"ready after {time.monotonic() - started:.0f} s: {middleware()}")


def middleware() -> str:
    """Return the middleware that .venv has."""
    return run_python("-c", MIDDLEWARE).stdout.strip()


def usable(stamp: dict[str, Any], wanted: dict[str, Any]) -> bool:
    """Return True if there is a .venv that works, of this Python, and that was not moved here.

    When a file moves from one distribution to another, pip installs the one, then removes the file
    with the old version of the other: with other distributions .venv is recreated.
    """
    return (
        (not stamp or all(stamp.get(key) == wanted[key] for key in ("python", "distributions")))
        and PYTHON.exists()
        and pip_version() is not None
    )


def read_stamp() -> dict[str, Any]:
    """Return what was installed last; nothing if .venv is missing, broken or not made by this."""
    if not PYTHON.exists():  # the link leads nowhere when its Python was removed
        return {}
    try:
        stamp: dict[str, Any] = json.loads(STAMP.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return stamp


def fingerprint() -> str:
    """Return the hash of the files whose changes need a new installation of the packages."""
    files = [ROOT / "pyproject.toml", LEARNING / "package.xml"]
    for folder in distributions():
        files += [*folder.glob("*.toml"), *folder.glob("setup.*"), *folder.glob("*_build.py")]
        other = (".py", ".typed")  # code, and what the installation itself writes
        files += [path for path in folder.glob("prefix/**/*") if path.suffix not in other]
        files += folder.glob("prefix/share/**/*.py")  # launch files, which pip copies
    files += ROS.glob("*/*/share/**/*")
    msg = ENGINE / "src" / "turtlewire" / "msg"
    files += [msg / "generate.py", *msg.glob("interfaces/*")]
    names = [str(package.relative_to(ROOT)) for package in packages()]
    digest = hashlib.sha256(repr(names).encode())
    for path in sorted(files):
        if path.is_file() and "__pycache__" not in path.parts:
            digest.update(str(path.relative_to(ROOT)).encode())
            digest.update(path.read_bytes())
    return digest.hexdigest()


def interrupt(_signum: int, _frame: object) -> NoReturn:
    """End as after Ctrl-C; a second signal, which a terminal sends too, is ignored."""
    for signum in ENDING:
        signal.signal(signum, lambda _signum, _frame: None)
    raise KeyboardInterrupt


def run(arguments: list[str]) -> int:
    """Set up, and say in one line what went wrong; return the exit status."""
    for signum in ENDING:
        signal.signal(signum, interrupt)
    try:
        main(parse_extras(arguments))
    except (SetupError, OSError) as error:  # for example, the disk is full
        say(str(error))
        return 1
    except KeyboardInterrupt:
        say("interrupted; the next run continues")
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(run(sys.argv[1:]))
