"""Finds the executable that ``ros2 run PACKAGE EXECUTABLE`` runs.

An executable is a file: ``<prefix>/lib/PACKAGE/EXECUTABLE`` of a prefix, or the console script of a
package that pip installed (pip puts those into the environment's ``bin``). A file that starts with
a Python shebang runs on this interpreter, not on the one in the shebang: a workspace that another
colcon built names the system's Python there, which does not have this distribution.
"""

from __future__ import annotations

import os
import sys

from turtlewire_ros.prefix import package_prefix


def libexec_directory(prefix: str, package: str) -> str:
    """Return the folder in which a prefix keeps the executables of a package."""
    return os.path.join(prefix, "lib", package)


def executable_paths(package: str) -> list[str] | None:
    """Paths of all executables of ``package``, sorted; None when there is no such package.

    Raises:
        OSError: The package's folder cannot be read.
    """
    prefix = package_prefix(package)
    if prefix is None:
        return None
    return _libexec_files(libexec_directory(prefix, package)) or _console_scripts(package)


def argv_for(path: str) -> list[str]:
    """The command that runs the executable at ``path``; Python scripts run on this interpreter."""
    return [sys.executable, path] if is_python_script(path) else [path]


def is_python_script(path: str) -> bool:
    """Return True if the first line of the file is a shebang that names a Python."""
    try:
        with open(path, "rb") as file:
            first_line = file.readline(512)  # a binary may contain megabytes without a line feed
    except OSError:
        return False
    return first_line.startswith(b"#!") and b"python" in first_line


def _libexec_files(folder: str) -> list[str]:
    if not os.path.isdir(folder):
        return []
    found = []
    for base, folders, files in os.walk(folder):
        # Assigned to the slice, because `os.walk` descends into what is left in this list.
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        found += [path for name in files if _is_executable(path := os.path.join(base, name))]
    return sorted(found)


def _is_executable(path: str) -> bool:
    # Windows has no executable bit, and some installers drop it from data files; a Python shebang
    # says the same.
    return os.access(path, os.X_OK) or is_python_script(path)


def _console_scripts(package: str) -> list[str]:
    from importlib.metadata import PackageNotFoundError, distribution

    try:
        files = distribution(package).files or []
    except (PackageNotFoundError, ValueError):
        return []
    return sorted(
        str(os.path.realpath(str(file.locate())))
        for file in files
        if file.parent.name in ("bin", "Scripts")
    )
