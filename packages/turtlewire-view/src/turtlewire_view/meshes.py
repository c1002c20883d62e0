"""Meshes of packages for the page: addresses in descriptions to URLs, and URLs to files.

Descriptions and markers name files as ``package://<package>/<path>``. The page may only ask for
meshes and textures of packages that a description or marker named, below their share folders.
"""

from __future__ import annotations

import logging
import os
import re
import sys
from typing import TYPE_CHECKING, NamedTuple
from urllib.parse import quote, unquote, urlsplit

from turtlewire.terminal.printable import printable
from turtlewire.web import Content

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = [
    "MEDIA_TYPES",
    "MeshAddress",
    "MeshFile",
    "MeshLibrary",
    "file_of_package",
    "mesh_address",
]

#: Kinds of files that are served, and their media types: meshes, and what they refer to.
MEDIA_TYPES = {
    ".stl": "model/stl",
    ".dae": "model/vnd.collada+xml",
    ".obj": "model/obj",
    ".mtl": "model/mtl",
    ".glb": "model/gltf-binary",
    ".gltf": "model/gltf+json",
    ".bin": "application/octet-stream",
    ".png": "image/png",
    ".jpg": "image/jpeg",
    ".jpeg": "image/jpeg",
    ".webp": "image/webp",
    ".bmp": "image/bmp",
}
#: What the page has a loader for.
_MESHES = (".stl", ".dae", ".obj", ".glb", ".gltf")
_PACKAGE_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_LARGEST_FILE = 256 * 2**20
_PREFIX = "/mesh/"
_MARKERS = os.path.join("share", "ament_index", "resource_index", "packages")
_logger = logging.getLogger(__name__)


class MeshAddress(NamedTuple):
    """Where the page finds a mesh.

    Attributes:
        url: Path on the server, None if the address is refused.
        problem: Why it is refused.
        packages: The package that must be permitted, if any.
    """

    url: str | None
    problem: str
    packages: tuple[str, ...] = ()

    def header(self) -> dict[str, str]:
        """Return the header for the page: ``url`` or ``problem``."""
        return {"problem": self.problem} if self.url is None else {"url": self.url}


class MeshFile(NamedTuple):
    """A file to serve."""

    path: str
    media_type: str


def mesh_address(uri: str, *, texture: bool = False) -> MeshAddress:
    """Return the URL path of a ``package://`` address, or of a ``file://`` one below a package.

    It is refused if there is no such file.

    Args:
        uri: The address as the description gives it.
        texture: Whether it is of an image.
    """
    if uri.startswith("package://"):
        package, _, path = uri.removeprefix("package://").partition("/")
        return _address(uri, package, unquote(path), texture)
    if uri.startswith(("file://", "/")):
        file = os.path.normpath(unquote(urlsplit(uri).path) if uri.startswith("file:") else uri)
        for package, path in _owners(file):
            return _address(uri, package, path, texture)
        return MeshAddress(
            None,
            f"'{uri}' is not below the share folder of a package; "
            "name it package://<package>/<path>",
        )
    return MeshAddress(
        None, f"'{uri}' is not loaded: only package:// addresses are, and file:// ones of packages"
    )


def file_of_package(uri: str) -> str | None:
    """The path of a ``package://`` address; None if it is none, or there is no such package."""
    package, _, path = uri.removeprefix("package://").partition("/")
    path = unquote(path)
    return None if _problem(package, path) else _file_of(package, path) or None


class MeshLibrary:
    """The files that the page may ask for."""

    def __init__(self) -> None:
        self._permitted: set[str] = set()

    def permit(self, packages: Iterable[str]) -> None:
        """Serve meshes and textures of these packages from now on. For any thread."""
        self._permitted.update(packages)

    def answer(self, url_path: str) -> Content | None:
        """Return the file that the page asks for, as :class:`turtlewire.web.Server` wants it."""
        if not url_path.startswith(_PREFIX):
            return None
        found = self.find(url_path)
        if isinstance(found, str):
            _logger.warning("The page did not get %s: %s", printable(url_path), printable(found))
            return None
        with open(found.path, "rb") as file:
            return Content(file.read(), found.media_type)

    def find(self, url_path: str) -> MeshFile | str:
        """Return the file of ``/mesh/<package>/<path>``, or the line with the reason.

        Args:
            url_path: The path, its escapes decoded.
        """
        package, _, path = url_path.removeprefix(_PREFIX).partition("/")
        problem = _problem(package, path)
        if not problem and package not in self._permitted:
            problem = f"no robot or marker names a mesh of the package '{package}'"
        if problem:
            return problem
        media_type = MEDIA_TYPES.get(os.path.splitext(path)[1].lower())
        if media_type is None:
            return f"'{path}' is neither a mesh nor a texture"
        file = _file_of(package, path)
        missing = _missing(package, path, file)
        return missing or MeshFile(file, media_type)


def _share_folder(package: str) -> str | None:
    """Return the share folder of a package, from the first prefix that has it."""
    for prefix in _prefixes():
        if os.path.isfile(os.path.join(prefix, _MARKERS, package)):
            return os.path.normpath(os.path.join(prefix, "share", package))
    return None


def _address(uri: str, package: str, path: str, texture: bool) -> MeshAddress:
    problem = _problem(package, path)
    if not problem:
        suffix = os.path.splitext(path)[1].lower()
        if texture and not MEDIA_TYPES.get(suffix, "").startswith("image/"):
            problem = f"'{path}' is not an image that browsers can show"
        elif not texture and suffix not in _MESHES:
            problem = f"'{path}' is not a mesh that the page can read ({', '.join(_MESHES)})"
    problem = problem or _missing(package, path, _file_of(package, path))
    if problem:
        return MeshAddress(None, f"'{uri}' is not loaded: {problem}")
    return MeshAddress(_PREFIX + package + "/" + quote(path), "", (package,))


def _problem(package: str, path: str) -> str:
    """Return why a file with this name is not served, or an empty string."""
    if not _PACKAGE_NAME.fullmatch(package):
        return f"'{package}' is not the name of a package"
    parts = path.split("/")
    if any(part in {"", ".", ".."} for part in parts):
        return f"the path '{path}' does not stay below the package"
    if any(letter in path for letter in "\\\0:") or any(part.startswith(".") for part in parts):
        return f"the path '{path}' holds a name that is not served"
    return ""


def _file_of(package: str, path: str) -> str:
    """Return the path of a package's file; empty if the package does not exist."""
    share = _share_folder(package)
    return "" if share is None else os.path.join(share, *path.split("/"))


def _missing(package: str, path: str, file: str) -> str:
    """Return why a file cannot be served, or an empty string."""
    if not file:
        return f"there is no package '{package}' in AMENT_PREFIX_PATH"
    if not os.path.isfile(file):
        return f"the package '{package}' has no file '{path}'"
    if os.path.getsize(file) > _LARGEST_FILE:
        return f"'{path}' is larger than {_LARGEST_FILE // 2**20} MiB"
    return ""


def _prefixes() -> list[str]:
    paths = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    return [*filter(None, paths), sys.prefix]


def _owners(file: str) -> Iterable[tuple[str, str]]:
    """Package and path in it, for each share folder that a file lies in."""
    for package, folder in _shares():
        if file.startswith(folder + os.sep):
            yield package, os.path.relpath(file, folder).replace(os.sep, "/")


def _shares() -> Iterable[tuple[str, str]]:
    """Packages and their share folders, in the order in which ROS 2 searches."""
    for prefix in _prefixes():
        markers = os.path.join(prefix, _MARKERS)
        if os.path.isdir(markers):
            for package in sorted(os.listdir(markers)):
                yield package, os.path.normpath(os.path.join(prefix, "share", package))
