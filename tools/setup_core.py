"""Provides the compiled core for the set-up: from this user's cache, or by compiling it.

The core is one file next to the Python modules. The cache stores it under a key of all its inputs:
sources, compiler, flags and Python. Another checkout with the same inputs does not compile again.
"""

from __future__ import annotations

import hashlib
import os
import platform
import re
import shlex
import shutil
import subprocess
import sysconfig
import tempfile
import zipfile
from pathlib import Path

from distributions import ENGINE, cache_folder, keep
from setup_steps import LOG, pip, say, stage, type_this

MODULE = f"_native{sysconfig.get_config_var('EXT_SUFFIX')}"
CORE = ENGINE / "src" / "turtlewire" / MODULE
#: How many cores of older sources the cache keeps; each has about 1 MB.
KEPT = 10
#: Environment variables that compilers, CMake and scikit-build-core read; prefixes of names.
FLAGS = ("CFLAGS", "CXXFLAGS", "CPPFLAGS", "LDFLAGS", "CMAKE_", "SKBUILD_")
PLAIN = "everything runs on plain Python, more slowly and with the same answers"


def core_key() -> str:
    """Return what identifies the compiled core; empty where it cannot be compiled."""
    compiler = compiler_version()
    if not compiler or not (Path(sysconfig.get_path("include")) / "Python.h").exists():
        return ""
    flags = sorted(pair for pair in os.environ.items() if pair[0].startswith(FLAGS))
    digest = hashlib.sha256(repr((compiler, flags, platform.machine(), MODULE)).encode())
    settings = (ENGINE / "pyproject.toml").read_text(encoding="utf-8")
    for section in re.split(r"^(?=\[)", settings, flags=re.MULTILINE):
        if section.startswith(("[build-system]", "[tool.scikit-build", "[[tool.scikit-build")):
            digest.update(section.encode())
    native = ENGINE / "native"
    sources = [path for path in native.glob("*/*.?pp") if path.parent.name != "tests"]
    for path in sorted([native / "CMakeLists.txt", *sources]):
        digest.update(str(path.relative_to(ENGINE)).encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()


def compiler_version() -> str:
    """Return the C++ compiler's description of itself; empty without a compiler."""
    named = shlex.split(os.environ.get("CXX", ""))
    for command in filter(None, (named, ["c++"], ["g++"], ["clang++"])):
        if shutil.which(command[0]):
            done = subprocess.run(
                [*command, "--version"], capture_output=True, text=True, check=False
            )
            # macOS has a c++ that only says how to install the compiler.
            return done.stdout if done.returncode == 0 else ""
    return ""


def provide_core(key: str) -> None:
    """Put the compiled core of a key next to the Python modules, or report why it is missing."""
    CORE.unlink(missing_ok=True)  # one of other sources
    if not key:
        remedy = "install a C++ compiler and Python's headers, then type the same again"
        if shutil.which("apt"):
            remedy = type_this("g++ python3-dev")
        say(f"the core is not compiled: {PLAIN}. For the fast one, {remedy}")
        return
    kept = cache_folder() / "core" / key / MODULE
    if kept.exists():
        kept.parent.touch()
        keep(kept, CORE)
        say(f"the compiled core is taken from {kept.parent.parent}")
        return
    with stage("compiling the core"):
        compile_core()
    if not CORE.exists():
        say(f"the core does not compile here (see {LOG}): {PLAIN}")
        return
    try:
        keep(CORE, kept)
        forget_old_cores(kept.parent.parent)
    except OSError as error:
        say(f"the compiled core is not kept for other checkouts: {error}")


def compile_core() -> None:
    """Build a wheel and take the core out of it; a wheel without it does not compile here."""
    with tempfile.TemporaryDirectory() as folder:
        build = f"build-dir={folder}/build"
        pip("wheel", "-v", "--no-deps", "-w", folder, "-C", build, str(ENGINE))
        (wheel,) = Path(folder).glob("*.whl")
        with zipfile.ZipFile(wheel) as files:
            if f"turtlewire/{MODULE}" in files.namelist():
                CORE.write_bytes(files.read(f"turtlewire/{MODULE}"))


def forget_old_cores(folder: Path) -> None:
    """Remove the cores that were not used for the longest time."""
    cores = sorted(folder.iterdir(), key=lambda core: core.stat().st_mtime)
    for core in cores[:-KEPT]:
        shutil.rmtree(core)
