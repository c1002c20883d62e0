"""Finds packages: named by the user, around a URDF file, or in the ament index."""

from __future__ import annotations

import hashlib
import os
import re
import sys
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse

__all__ = ["PACKAGE_NAME", "PackageFolders", "add_package_option"]

PACKAGE_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_MARKERS = os.path.join("share", "ament_index", "resource_index", "packages")
_NAME_IN_XML = re.compile(rb"<name>\s*([^<\s]*)\s*</name>")
_LARGEST_XML = 2**16


class PackageFolders:
    """Finds the folders of packages. Immutable.

    Args:
        named: Folders by names of packages; they come first.
        file: A URDF file. A package whose ``package.xml`` is above it, or in a folder next to
            those above it, is found without the index, and its meshes may have paths.
        roots: Folders with packages that need no ``package.xml``: a folder's name is the package's.
    """

    def __init__(
        self,
        named: Mapping[str, str] | None = None,
        file: str | None = None,
        roots: Sequence[str] = (),
    ) -> None:
        self._named = {name: os.path.abspath(folder) for name, folder in (named or {}).items()}
        self._roots = tuple(map(os.path.abspath, roots))
        self._above = () if file is None else tuple(_folders_above(os.path.abspath(file)))

    def beside(self, file: str) -> PackageFolders:
        """Return a finder that also searches around a URDF file."""
        return PackageFolders(self._named, file, self._roots)

    def folder(self, package: str) -> str | None:
        """Return the folder of a package; None if it is unknown."""
        if package in self._named:
            return self._named[package]
        for above in self._above:
            for folder in (above, os.path.join(above, package)):
                if _name_of(folder) == package:
                    return folder
        for folder in (*self._above, *(os.path.join(root, package) for root in self._roots)):
            if os.path.basename(folder) == package and os.path.isdir(folder):
                return folder
        return _folder_in_index(package)

    def path_beside(self, path: str) -> str | None:
        """Return a path that is relative to the URDF file or to a root; None without a file."""
        if not self._above:
            return None
        paths = [os.path.normpath(os.path.join(at, path)) for at in (self._above[0], *self._roots)]
        return next(filter(os.path.isfile, paths), paths[0])

    def owner_of(self, file: str) -> tuple[str, str] | None:
        """Return name and folder of the package that a file lies in.

        With a URDF file, all files have an owner: for one outside of packages, it is a folder, and
        the name is made up.
        """
        for package, folder in self._packages():
            if file.startswith(folder + os.sep):
                return package, folder
        if not self._above:
            return None
        near = self._above[:2]  # meshes are often in "../meshes", and their images in "../textures"
        around = (folder for folder in near if file.startswith(folder.rstrip(os.sep) + os.sep))
        folder = next(around, os.path.dirname(file))
        return f"folder-{hashlib.sha256(os.fsencode(folder)).hexdigest()[:12]}", folder

    def _packages(self) -> Iterator[tuple[str, str]]:
        """Packages and their folders, in the order in which they are searched."""
        yield from self._named.items()
        for folder in self._above:
            if name := _name_of(folder):
                yield name, folder
        for prefix in _prefixes():
            markers = os.path.join(prefix, _MARKERS)
            if os.path.isdir(markers):
                for package in sorted(os.listdir(markers)):
                    yield package, os.path.normpath(os.path.join(prefix, "share", package))


def add_package_option(parser: argparse.ArgumentParser) -> None:
    """Add ``--package NAME=FOLDER``, whose value is a list of pairs."""
    parser.add_argument(
        "--package",
        action="append",
        default=[],
        type=_named_folder,
        metavar="NAME=FOLDER",
        help="Read package://NAME/… from this folder; may be given several times",
    )


def _named_folder(text: str) -> tuple[str, str]:
    """Return name and folder of an argument."""
    import argparse

    name, equals, folder = text.partition("=")
    if not (equals and folder and PACKAGE_NAME.fullmatch(name)):
        raise argparse.ArgumentTypeError(f"{text!r} is not NAME=FOLDER, such as arm=src/arm")
    folder = os.path.expanduser(folder)
    if not os.path.isdir(folder):
        raise argparse.ArgumentTypeError(f"{folder!r}, given for the package {name}, is no folder")
    return name, folder


def _folder_in_index(package: str) -> str | None:
    """Return the share folder of a package, from the first prefix that has it."""
    for prefix in _prefixes():
        if os.path.isfile(os.path.join(prefix, _MARKERS, package)):
            return os.path.normpath(os.path.join(prefix, "share", package))
    return None


def _prefixes() -> list[str]:
    paths = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    return [*filter(None, paths), sys.prefix]


def _folders_above(file: str) -> Iterator[str]:
    """The folder of a file, the one that holds it, and so on."""
    folder = os.path.dirname(file)
    while True:
        yield folder
        if (above := os.path.dirname(folder)) == folder:
            return
        folder = above


def _name_of(folder: str) -> str:
    """Return the name in a folder's ``package.xml``; empty without one."""
    try:
        with open(os.path.join(folder, "package.xml"), "rb") as file:
            found = _NAME_IN_XML.search(file.read(_LARGEST_XML))
    except OSError:
        return ""
    return found[1].decode(errors="replace") if found else ""
