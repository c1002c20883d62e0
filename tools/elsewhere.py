"""The implementation of scripts/elsewhere: tries wheels in a venv of another Debian.

Debian's packages are only unpacked. The venv's `python` is a script that starts the other Debian's
Python, by the emulator or by that Debian's own loader. `sys.executable` and the commands name this
script, so the processes of the demo also run there.
"""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parent))

from distributions import ENGINE, LEARNING, ROS
from release_wheels import ROOT, ReleaseError, interpreter, run, say, wheel_tag
from script_options import ScriptParser

HOME = ROOT / "build" / "elsewhere"
WHEELS = ROOT / "build" / "release"
NEEDS = {"mmdebstrap": "mmdebstrap"}
EMULATOR_NEEDS = NEEDS | {"arch-test": "arch-test", "qemu-aarch64-static": "qemu-user-static"}
EMULATED = 'qemu-aarch64-static -L {root} -0 "$0"'
LOADED = '{root}/usr/lib64/ld-linux-x86-64.so.2 --argv0 "$0" --library-path {libraries}'
TEST_PACKAGES = (
    *("pytest", "pytest-timeout", "pytest-xdist", "hypothesis", "scipy", "transforms3d"),
    *("eclipse-zenoh>=1.9", "xxhash", "zenoh-ros2-sdk"),
)


class OtherSystem(NamedTuple):
    """Another Debian with its Python."""

    suite: str
    architecture: str  # as Debian names it
    machine: str  # as wheels name it
    version: str  # of Python
    library: str  # Debian's package of libddsc
    tests: tuple[str, ...]

    @property
    def emulated(self) -> bool:
        """True if this machine's processor cannot run it."""
        return self.machine == "aarch64"

    @property
    def folder(self) -> Path:
        """Folder of the root file system."""
        return HOME / f"{self.suite}-{self.architecture}"

    @property
    def root(self) -> Path:
        """The Debian."""
        return self.folder / "root"

    @property
    def python(self) -> Path:
        """Python of the venv."""
        return self.folder / "venv" / "bin" / "python"


PLACES = {
    "arm64": OtherSystem(
        *("bookworm", "arm64", "aarch64", "3.11", "libddsc0debian"),
        (f"{ENGINE}/tests/tf/test_buffer.py", f"{ENGINE}/tests/tf/test_batch.py"),
    ),
    "python3.14": OtherSystem(
        *("forky", "amd64", "x86_64", "3.14", "libddsc0t64"),
        (
            "-n2",
            "-m",
            "not slow",
            f"{ENGINE}/tests/tf",
            f"{ROS}/geometry2/tests/tf2_py",
            f"{ENGINE}/tests/wire",
        ),
    ),
}
MIDDLEWARES = ("rmw_zenoh_cpp", "rmw_cyclonedds_cpp")


def main() -> int:
    """Prepare what is missing, and run the trials; the exit status."""
    parser = ScriptParser(
        prog="scripts/elsewhere",
        description="Tries the wheels in build/release, as they are, with the Python of another "
        "Debian; scripts/release makes new ones.",
    )
    parser.add_argument("place", choices=PLACES, help="bookworm's arm64 under qemu, or forky")
    parser.add_argument(
        "--only",
        choices=("prepare", "tests", "demo"),
        help="one step; `tests` and `demo` need no network once that is prepared",
    )
    arguments = parser.parse_args()
    place = PLACES[arguments.place]
    try:
        if arguments.only in {None, "prepare"} or not (place.folder / "ready").exists():
            prepare(place)
        if arguments.only in {None, "tests"}:
            run_tests(place)
        if arguments.only in {None, "demo"}:
            run_demo(place)
    except ReleaseError as error:
        print(f"[elsewhere] {error}", file=sys.stderr)
        return 1
    return 0


def run_tests(place: OtherSystem) -> None:
    """Check that the compiled core exists, and run tests with it."""
    trial = "import platform, turtlewire.tf.buffer as b; print(platform.machine(), b.CORE)"
    told = run(place.python, "-c", trial, what="the import").strip()
    if told != f"{place.machine} native":
        raise ReleaseError(f"the core is not there: {told}")
    command = [place.python, "-m", "pytest", "-q", "-p", "no:cacheprovider", *place.tests]
    say(run(*command, what="the tests").strip().splitlines()[-1])


def run_demo(place: OtherSystem) -> None:
    """Run the follow demo on each middleware, with this Debian's DDS library."""
    for middleware in MIDDLEWARES:
        environment = dict(os.environ)
        if not place.emulated:  # the emulator looks below the root by itself
            environment["CYCLONEDDS_HOME"] = str(place.root / "usr")
        command = [place.python, ROOT / "tools" / "elsewhere_follow.py", middleware]
        if place.emulated and middleware == "rmw_zenoh_cpp":
            # Without a router, Zenoh's peers find each other by multicast: QEMU 7.2 refuses to
            # choose its interface (IP_MULTICAST_IF: "Protocol not available").
            command.append("--router")
        done = run(*command, what=f"the demo on {middleware}", environment=environment)
        say(done.strip().splitlines()[-1])


def prepare(place: OtherSystem) -> None:
    """Debian, the venv and the wheels in it."""
    needs = EMULATOR_NEEDS if place.emulated else NEEDS
    missing = [package for command, package in needs.items() if shutil.which(command) is None]
    if missing:
        raise ReleaseError(f"not installed: {', '.join(missing)}; apt install {' '.join(missing)}")
    if not (place.folder / "unpacked").exists():
        unpack(place)
    (place.folder / "ready").unlink(missing_ok=True)
    make_venv(place)
    install(place)
    (place.folder / "ready").touch()


def unpack(place: OtherSystem) -> None:
    """Debian's Python and libddsc; the folder is whole once the mark is there."""
    shutil.rmtree(place.root, ignore_errors=True)
    place.folder.mkdir(parents=True, exist_ok=True)
    command = ["mmdebstrap", f"--arch={place.architecture}", "--variant=extract"]
    command += ["--skip=check/qemu", f"--include=python{place.version},{place.library}"]
    command += ['--aptopt=Acquire::Check-Valid-Until "false"', place.suite, str(place.root)]
    run(*command, what=f"Debian {place.suite}, {place.architecture}")
    compile_modules(place, place.root / "usr" / "lib" / f"python{place.version}")
    (place.folder / "unpacked").touch()


def compile_modules(place: OtherSystem, folder: Path) -> None:
    """Compile Python's modules here, for which an emulated Python takes minutes."""
    if not place.emulated:
        return
    python = interpreter(place.version)
    if python is None:
        raise ReleaseError(f"Python {place.version} is not on this machine; it compiles modules")
    run(python, "-m", "compileall", "-q", "-j2", folder, what=f"bytecode in {folder.name}")


def make_venv(place: OtherSystem) -> None:
    """An empty venv whose Python is the other Debian's."""
    venv = place.python.parent.parent
    shutil.rmtree(venv, ignore_errors=True)
    place.python.parent.mkdir(parents=True)
    home = "/usr/bin" if place.emulated else place.root / "usr" / "bin"
    (venv / "pyvenv.cfg").write_text(
        f"home = {home}\ninclude-system-site-packages = false\nversion = {place.version}\n",
        encoding="utf-8",
    )
    libraries = place.root / "usr" / "lib" / f"{place.machine}-linux-gnu"
    start = (EMULATED if place.emulated else LOADED).format(root=place.root, libraries=libraries)
    program = place.root / "usr" / "bin" / f"python{place.version}"
    place.python.write_text(f'#!/bin/sh\nexec {start} {program} "$@"\n', encoding="utf-8")
    place.python.chmod(0o755)


def install(place: OtherSystem) -> None:
    """The wheels with all that they ask for there.

    An emulated pip would take many minutes, so this machine's pip resolves and downloads.
    """
    wheels = place.folder / "wheels"
    shutil.rmtree(wheels, ignore_errors=True)
    tools = HOME / "tools" / "bin" / "python"
    if not tools.exists():
        run(sys.executable, "-m", "venv", HOME / "tools", what="a venv for the tools")
    run(tools, "-m", "pip", "install", "-q", "installer", "packaging", what="the tools")
    command = [tools, "-m", "pip", "wheel", "-q", "--no-deps", "-w", wheels, LEARNING]
    run(*command, what="the wheel of the tutorial's package")
    for path in ours(place):
        shutil.copy(path, wheels)
    venv = place.python.parent.parent
    command = [tools, ROOT / "tools" / "elsewhere_wheels.py"]
    command += [wheels, venv, place.version, place.machine]
    run(*command, *TEST_PACKAGES, what="the wheels and their dependencies")
    compile_modules(place, venv / "lib" / f"python{place.version}" / "site-packages")


def ours(place: OtherSystem) -> list[Path]:
    """Return the release's wheels for this Python."""
    tag = wheel_tag(place.version)
    patterns = (f"turtlewire-*-{tag}-*{place.machine}.whl", "turtlewire_ros-*.whl")
    if not all(list(WHEELS.glob(pattern)) for pattern in patterns):
        raise ReleaseError(
            f"build/release has no wheel {tag} for {place.machine}: scripts/release makes it"
        )
    return [path for pattern in patterns for path in WHEELS.glob(pattern)]


if __name__ == "__main__":
    sys.exit(main())
