"""The wheels of a release: one for Python 3.10, one for 3.11, one for 3.12 and all later ones.

Each is made from the sdist, so that nothing is missing in it. Free-threaded Pythons, which the
stable ABI leaves out, get one each. Linux wheels get their manylinux tag from auditwheel, which
finds the oldest glibc that they run on: build on a system whose glibc is old enough. Debian's cross
compiler builds the wheels for arm64 on x86-64, with the C library of the same Debian.
"""

from __future__ import annotations

import glob
import os
import platform
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "build" / "release"


class ReleaseError(Exception):
    """The release cannot be built; the text is one sentence."""


def run(
    *command: object,
    what: str,
    environment: dict[str, str] | None = None,
    folder: Path = ROOT,
) -> str:
    """Run a step, and say how long it took; returns what it printed.

    Raises:
        ReleaseError: The command failed; its output was printed.
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
    return done.stdout


def install_locked(python: Path, lock: str, *, what: str) -> None:
    """Install the releases of a file of ``tools/locks``, checked by their hashes.

    Raises:
        ReleaseError: pip failed; its output was printed.
    """
    file = ROOT / "tools" / "locks" / f"{lock}.txt"
    run(python, "-m", "pip", "install", "-q", "--require-hashes", "-r", file, what=what)


def output(*command: str) -> str:
    """Return a command's output."""
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode:
        raise ReleaseError(f"{' '.join(command)}: {done.stderr.strip()}")
    return done.stdout.strip()


def say(text: str) -> None:
    """Print a line for the user."""
    print(f"[{Path(sys.argv[0]).stem}] {text}", file=sys.stderr, flush=True)


VERSIONS = ("3.10", "3.11", "3.12", "3.13", "3.14", "3.13t", "3.14t")
MACHINES = ("x86_64", "aarch64")
OWN = ("3.10", "3.11")  # older than nanobind's stable ABI
#: CMake 3.26 is the first to find what a module of the stable ABI links with. `scripts/lock` writes
#: which releases these are.
BACKEND = ("build", "scikit-build-core>=1.0", "nanobind>=2.2", "cmake>=3.26", "ninja", "hatchling")
CROSS = "aarch64-linux-gnu-g++"
TOOLCHAIN = f"""set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER {CROSS})
"""


@dataclass(frozen=True)
class Target:
    """One compiled wheel."""

    tag: str  # of Python and ABI, as in the file's name
    python: str  # the interpreter that builds it
    machine: str

    @property
    def stable(self) -> bool:
        """True if it is for all later Pythons, too."""
        return self.tag.endswith("abi3")

    @property
    def foreign(self) -> bool:
        """True if it does not run here."""
        return self.machine != here()


def here() -> str:
    """Return the machine that this is, as wheels name it."""
    return {"AMD64": "x86_64", "arm64": "aarch64"}.get(platform.machine(), platform.machine())


def interpreters(versions: tuple[str, ...]) -> dict[str, str]:
    """Return the Pythons that this machine has, by version.

    Raises:
        ReleaseError: A version is not installed.
    """
    found = {version: path for version in versions if (path := interpreter(version))}
    missing = [version for version in versions if version not in found]
    if missing:
        say(f"not on this machine: Python {', '.join(missing)}")
    if not found:
        raise ReleaseError("none of these Pythons is on this machine")
    return found


def interpreter(version: str) -> str | None:
    """A Python of a version that can make a venv; pyenv's own, because its shims may fail."""
    number, free = version.rstrip("t"), version.endswith("t")
    pattern = f"~/.pyenv/versions/{number}.*{'t' if free else '[0-9]'}/bin/python"
    for path in [*sorted(glob.glob(os.path.expanduser(pattern))), shutil.which(f"python{version}")]:
        if path and subprocess.run([path, "-c", "import ensurepip"], check=False).returncode == 0:
            return path
    return None


def targets(pythons: dict[str, str], machines: tuple[str, ...]) -> list[Target]:
    """Return the wheels that these Pythons can build: no two with the same tag."""
    found: dict[tuple[str, str], Target] = {}
    for machine in machines:
        for version, python in pythons.items():
            tag = wheel_tag(version)
            found.setdefault((machine, tag), Target(tag, python, machine))
    return list(found.values())


def wheel_tag(version: str) -> str:
    """Return the tag of the wheel that a Python takes."""
    number = f"cp{version.rstrip('t').replace('.', '')}"
    if version.endswith("t"):
        return f"{number}-{number}t"
    return f"{number}-{number}" if version in OWN else "cp312-abi3"


def possible_machines(asked: tuple[str, ...]) -> tuple[str, ...]:
    """Return the machines for which this one can compile.

    Raises:
        ReleaseError: A machine was asked for by name, and its compiler is missing.
    """
    if sys.platform != "linux":
        return (here(),)
    others = [machine for machine in asked if machine != here()]
    if not others:
        return asked
    if here() == "x86_64" and shutil.which(CROSS):
        return asked
    need = f"{', '.join(others)} needs {CROSS} on x86-64: apt install g++-aarch64-linux-gnu"
    if len(asked) == len(others):
        raise ReleaseError(need)
    say(f"{need}; no such wheels")
    return tuple(machine for machine in asked if machine == here())


def make_builder(python: str) -> Path:
    """Return a venv with what builds a wheel, kept from one run to the next; its Python."""
    version = subprocess.run(
        [python, "-c", "import sys; print('%d.%d' % sys.version_info[:2] + sys.abiflags)"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout.strip()
    venv = WORK.parent / "release-tools" / version
    if not (venv / "bin" / "python").exists():
        run(python, "-m", "venv", "--clear", venv, what=f"a venv for Python {version}")
    install_locked(venv / "bin" / "python", "build", what=f"what builds with Python {version}")
    return venv / "bin" / "python"


def make_sdist(python: Path, name: str, folder: Path, into: Path) -> Path:
    """Return the sdist of a project, in another folder."""
    command = [python, "-m", "build", "--no-isolation", "--sdist", "-o", into, folder]
    run(*command, what=f"the sdist of {name}")
    [path] = into.glob(f"{name.replace('-', '_')}-*.tar.gz")
    return path


def make_wheel(python: Path, source: Path, target: Target | None, folder: Path) -> Path:
    """Return the wheel of an unpacked sdist; a pure one where there is no target."""
    options: list[str] = []
    environment = {**os.environ, "PATH": f"{python.parent}{os.pathsep}{os.environ['PATH']}"}
    what = f"the wheel of {source.name}"
    if target is not None:
        what = f"{what}, {target.tag} for {target.machine}"
        if target.stable:
            options += ["-Cwheel.py-api=cp312", "-Ccmake.define.TURTLEWIRE_STABLE_ABI=ON"]
        if target.foreign:
            options += [f"-Ccmake.define.Python_INCLUDE_DIR={headers(python)}"]
            environment |= cross_environment(target)
    command = [python, "-m", "build", "--no-isolation", "--wheel", "-o", folder, *options, source]
    run(*command, what=what, environment=environment)
    [wheel] = folder.glob("*.whl")
    if target is not None and wheel.name.endswith("none-any.whl"):
        raise ReleaseError(f"the core did not compile for {target.tag}: {wheel.name}")
    return wheel


def headers(python: Path) -> str:
    """Return the folder of Python's headers, which fit all processors with longs of 64 bits."""
    command = [str(python), "-c", "import sysconfig; print(sysconfig.get_path('include'))"]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


def cross_environment(target: Target) -> dict[str, str]:
    """Return the variables with which CMake and scikit-build-core compile for another machine."""
    toolchain = WORK / "toolchain.cmake"
    toolchain.write_text(TOOLCHAIN, encoding="utf-8")
    abi = "abi3" if target.stable else f"cpython-{target.tag.split('-')[1][2:]}"
    suffix = ".abi3.so" if target.stable else f".{abi}-{target.machine}-linux-gnu.so"
    return {
        "CMAKE_TOOLCHAIN_FILE": str(toolchain),
        "_PYTHON_HOST_PLATFORM": f"linux-{target.machine}",
        "SETUPTOOLS_EXT_SUFFIX": suffix,
    }
