"""Finds ROS packages: in colcon workspaces, in this distribution's prefix, and installed by pip.

A *prefix* is a folder with ``share/ament_index``, for example ``/opt/ros/jazzy``.
``AMENT_PREFIX_PATH`` lists the sourced workspaces' prefixes; the prefix this distribution
was installed into needs no sourcing and comes last.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

#: Folder of a prefix in which each installed package has a file of its name.
MARKERS = os.path.join("share", "ament_index", "resource_index", "packages")
#: Kind of the index entry in which a build here lists the C++ targets that it has left out.
COMPILED_TARGETS = "turtlewire_compiled_targets"


def own_prefix() -> str | None:
    """The prefix of this distribution's packages; None in a source tree that is not installed.

    It lies above ``site-packages`` in a virtual environment, in ``~/.local`` and in ``/usr/local``
    alike. An editable install runs from its source, and its data are in the environment of the
    interpreter.
    """
    candidates = [*Path(__file__).resolve().parents, Path(sys.prefix)]
    return next(
        (str(folder) for folder in candidates if (folder / MARKERS / "turtlewire_ros").is_file()),
        None,
    )


def prefixes() -> list[str]:
    """Return all prefixes that exist, in the order in which they are searched."""
    found = [
        path
        for path in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
        if path and os.path.isdir(path)
    ]
    own = own_prefix()
    if own is not None and own not in found:
        found.append(own)
    return found


def package_prefix(package: str) -> str | None:
    """Return the prefix of ``package``, the source folder of an editable install, or None."""
    return _indexed_prefix(package) or editable_source(package)


def share_directory(package: str) -> str | None:
    """Return the folder with package.xml, launch files and other data of ``package``, or None."""
    prefix = _indexed_prefix(package)
    return editable_source(package) if prefix is None else os.path.join(prefix, "share", package)


def package_names() -> dict[str, str]:
    """Return every installed package with its prefix, except for editable installs."""
    names: dict[str, str] = {}
    for prefix in prefixes():
        folder = os.path.join(prefix, MARKERS)
        if os.path.isdir(folder):
            for name in os.listdir(folder):
                names.setdefault(name, prefix)
    return names


def compiled_targets(package: str) -> list[str]:
    """Return the C++ targets of an installed package that were left out when it was built here."""
    prefix = _indexed_prefix(package)
    path = Path(prefix or os.devnull, os.path.dirname(MARKERS), COMPILED_TARGETS, package)
    return path.read_text(encoding="utf-8").splitlines() if path.is_file() else []


def editable_source(package: str) -> str | None:
    """Return the source folder of a package that was installed by ``pip install -e``, or None.

    Such an install has no data files. A folder with a package.xml stands in for the share folder;
    launch files have the same relative paths there.
    """
    import json
    from importlib.metadata import PackageNotFoundError, distribution
    from urllib.parse import unquote, urlparse

    try:
        record = distribution(package).read_text("direct_url.json")
    except (PackageNotFoundError, ValueError):
        return None
    origin = json.loads(record or "{}")
    url = urlparse(origin.get("url", ""))
    if not origin.get("dir_info", {}).get("editable") or url.scheme != "file":
        return None
    folder = Path(unquote(url.path))
    return str(folder) if (folder / "package.xml").is_file() else None


def _indexed_prefix(package: str) -> str | None:
    return next(
        (prefix for prefix in prefixes() if os.path.isfile(os.path.join(prefix, MARKERS, package))),
        None,
    )
