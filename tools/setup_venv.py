"""Creates .venv for the set-up, with pip and the packages."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Sequence
from importlib.util import find_spec

from distributions import COLCON, ROOT, distributions
from setup_steps import (
    PYTHON,
    VENV,
    SetupError,
    checked,
    clean_environment,
    pip,
    run_python,
    say,
    type_this,
)

#: The releases that CI installs, with their hashes.
LOCK = ROOT / "tools" / "locks" / "ci.txt"

#: pip that installs dependency groups of a pyproject.toml.
OLDEST_PIP = (25, 1)
#: pip that installs into another Python's environment.
OLDEST_OUTER_PIP = (22, 3)
#: Settings of pip that say where packages come from. uv does not read them.
PLACES = {
    *("index-url", "extra-index-url", "find-links", "no-index", "constraint"),
    *("cert", "client-cert", "trusted-host", "proxy"),
}


def make_venv(put_pip: list[str]) -> None:
    """Recreate .venv; the command of `pip_command` puts pip there."""
    # Inside of a venv, and this may be run with .venv's own Python, the one that it was made from.
    base: str = vars(sys)["_base_executable"]
    command = [base, "-m", "venv", "--without-pip", "--clear", str(VENV)]
    done = subprocess.run(
        command, capture_output=True, text=True, check=False, env=clean_environment()
    )
    if done.returncode:
        raise SetupError(f"could not make .venv:\n{done.stdout}{done.stderr}")
    checked(put_pip)
    if (pip_version() or OLDEST_PIP) < OLDEST_PIP:
        pip("install", f"pip>={OLDEST_PIP[0]}.{OLDEST_PIP[1]}")


def pip_command() -> list[str]:
    """Return the command that puts pip into a .venv without it.

    Debian's python3 has neither pip nor `ensurepip`; python3-venv brings the latter.

    Raises:
        SetupError: This machine has none.
    """
    if find_spec("ensurepip") is not None:
        return [str(PYTHON), "-m", "ensurepip"]
    if outer_pip_version() >= OLDEST_OUTER_PIP:
        return [sys.executable, "-m", "pip", "--python", str(PYTHON), "install", "pip"]
    if uv := shutil.which("uv"):
        return [uv, "pip", "install", "--python", str(PYTHON), "pip"]
    base = os.path.realpath(vars(sys)["_base_executable"])
    raise SetupError(how_to_get_pip(base, os.path.realpath("/usr/bin/python3")))


def outer_pip_version() -> tuple[int, ...]:
    """Return the version of this Python's own pip; (0, 0) without pip."""
    done = subprocess.run(
        [sys.executable, "-m", "pip", "--version"], capture_output=True, text=True, check=False
    )
    return version_of(done.stdout)


def how_to_get_pip(python: str, default: str) -> str:
    """Return what to do where a Python cannot put pip into a venv; the system has a default."""
    others = "an installed uv does as well, and PYTHON=... names another Python"
    if not python.startswith("/usr/bin/") or shutil.which("apt") is None:
        return f"{python} has no ensurepip, which puts pip into .venv; {others}"
    package = "python3-venv" if python == default else f"{os.path.basename(python)}-venv"
    return f"Python's venv package is missing; {type_this(package)}\n({others})"


def pip_version() -> tuple[int, ...] | None:
    """Return the version of the venv's pip; None without pip."""
    if not PYTHON.exists():
        return None
    done = run_python("-m", "pip", "--version")
    return version_of(done.stdout) if done.returncode == 0 else None


def version_of(text: str) -> tuple[int, ...]:
    """Return the first two numbers of ``pip 25.1.1 from …``."""
    numbers = re.search(r"(\d+)\.(\d+)", text)
    return (int(numbers[1]), int(numbers[2])) if numbers else (0, 0)


def install(extras: Sequence[str], *, only_extras: bool) -> None:
    """Install our distributions editable, unless they are installed, and the extras."""
    workspace = "[workspace]" if "workspace" in extras else ""
    # A distribution whose folder was deleted is left out.
    words = [f"turtlewire-colcon{workspace}" if COLCON.is_dir() else "turtlewire"]
    if not only_extras:
        folders = [f"{path}{workspace if path == COLCON else ''}" for path in distributions()]
        words = [word for folder in folders for word in ("-e", folder)]
    for name in extras:
        if name != "workspace":
            words += ["--group", f"{ROOT / 'pyproject.toml'}:{name}"]
    if os.environ.get("CI") == "true":  # what follows finds all but our own packages installed
        pip("install", "--require-hashes", "-r", str(LOCK))
    # The core is compiled apart from the package, and only if it is not kept yet: setup_core.py.
    settings = {"SKBUILD_WHEEL_CMAKE": "false"}
    uv = uv_to_use()
    if uv is None:
        pip("install", *words, settings=settings)
        return
    if not only_extras:  # uv would find them installed, although their metadata changed
        names = [folder.name.replace("_", "-") for folder in distributions()]
        words += [word for name in names for word in ("--reinstall-package", name)]
    checked([uv, "pip", "install", "--python", str(PYTHON), *words], settings)


def uv_to_use() -> str | None:
    """Return the path of uv; None if it is missing or would take packages from elsewhere."""
    uv = shutil.which("uv")
    if uv is None:
        return None
    told = run_python("-m", "pip", "config", "list").stdout
    places = sorted({*re.findall(r"^[^=\n]*\.([a-z-]+)=", told, re.MULTILINE)} & PLACES)
    if places:
        say(f"pip installs, not uv, which does not read pip's settings ({', '.join(places)})")
        return None
    return uv
