"""Meshes of packages for the page: addresses in descriptions to URLs, and URLs to files.

Descriptions and markers name files as ``package://<package>/<path>``, and descriptions in a file
also by path. The page may only ask for meshes and textures of packages, and of folders with such
paths, that a description or marker named.
"""

from __future__ import annotations

import io
import logging
import os
from collections.abc import Iterable
from importlib.util import find_spec
from typing import TYPE_CHECKING, NamedTuple
from urllib.parse import quote, unquote, urlsplit

from turtlewire.terminal.printable import printable
from turtlewire.web import WebContent
from turtlewire_view.package_folders import PACKAGE_NAME

if TYPE_CHECKING:
    from turtlewire_view.package_folders import PackageFolders

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
    ".tif": "image/png",  # converted
    ".tiff": "image/png",
}
_TIFF = (".tif", ".tiff")
#: What the page has a loader for.
_MESHES = (".stl", ".dae", ".obj", ".glb", ".gltf")
_LARGEST_FILE = 256 * 2**20
_PREFIX = "/mesh/"
_logger = logging.getLogger(__name__)


class MeshAddress(NamedTuple):
    """The address at which the page finds a mesh.

    Attributes:
        url: Path on the server, None if the address is refused.
        problem: Why it is refused.
        packages: Name and folder of the package that must be permitted, if any.
    """

    url: str | None
    problem: str
    packages: tuple[tuple[str, str], ...] = ()

    def header(self) -> dict[str, str]:
        """Return the header for the page: ``url`` or ``problem``."""
        return {"problem": self.problem} if self.url is None else {"url": self.url}


class MeshFile(NamedTuple):
    """A file to serve."""

    path: str
    media_type: str


def mesh_address(uri: str, packages: PackageFolders, *, texture: bool = False) -> MeshAddress:
    """Return the URL path of a ``package://`` address, a ``file://`` one, or a path.

    It is refused if there is no such file, or if the file belongs to no package: see
    :meth:`PackageFolders.owner_of`.

    Args:
        uri: The address as the description gives it.
        packages: Where packages lie.
        texture: Whether it is of an image.
    """
    if uri.startswith("package://"):
        package, _, path = uri.removeprefix("package://").partition("/")
        return _address(uri, package, unquote(path), packages.folder(package), texture)
    is_path = bool(uri) and "://" not in uri
    if not uri.startswith(("file://", "/")) and not (is_path and packages.path_beside(uri)):
        return MeshAddress(
            None,
            f"'{uri}' is not loaded: only package:// addresses are, and file:// ones of packages",
        )
    path = unquote(urlsplit(uri).path) if uri.startswith("file:") else uri
    file = packages.path_beside(path) or os.path.normpath(path)
    owner = packages.owner_of(file)
    if owner is None:
        return MeshAddress(
            None,
            f"'{uri}' is not below the share folder of a package; "
            "name it package://<package>/<path>",
        )
    inside = os.path.relpath(file, owner[1]).replace(os.sep, "/")
    return _address(uri, owner[0], inside, owner[1], texture)


def file_of_package(uri: str, packages: PackageFolders) -> str | None:
    """The path of a ``package://`` address; None for another address or an unknown package."""
    package, _, path = uri.removeprefix("package://").partition("/")
    path = unquote(path)
    return None if _problem(package, path) else _file_in(packages.folder(package), path) or None


class MeshLibrary:
    """The files that the page may ask for."""

    def __init__(self) -> None:
        self._permitted: dict[str, str] = {}

    def permit(self, packages: Iterable[tuple[str, str]]) -> None:
        """Serve meshes and textures of packages from now on: names and folders. For any thread."""
        self._permitted.update(packages)

    def answer(self, url_path: str) -> WebContent | None:
        """Return the file that the page asks for, as :class:`turtlewire.web.Server` wants it."""
        if not url_path.startswith(_PREFIX):
            return None
        found = self.find(url_path)
        if isinstance(found, MeshFile):
            try:
                return WebContent(_content(found.path), found.media_type)
            except ValueError as error:
                found = str(error)
        _logger.warning("The page did not get %s: %s", printable(url_path), printable(found))
        return None

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
        file = _file_in(self._permitted[package], path)
        missing = _missing(package, path, file)
        return missing or MeshFile(file, media_type)


def _content(path: str) -> bytes:
    """Return the content of a file as the page needs it.

    Raises:
        ValueError: The file cannot be read, or it needs Pillow, which is not installed.
    """
    if path.lower().endswith(_TIFF):
        return _png_of_tiff(path)
    try:
        with open(path, "rb") as file:
            return file.read()
    except OSError as error:
        raise ValueError(f"the file cannot be read: {error.strerror}") from error


def _png_of_tiff(path: str) -> bytes:
    """Return an image as PNG, because browsers do not show TIFF.

    Raises:
        ValueError: The image cannot be read, or Pillow is not installed.
    """
    if problem := _without_pillow(path):
        raise ValueError(problem)
    from PIL import Image

    png = io.BytesIO()
    try:
        with Image.open(path, formats=["TIFF"]) as image:
            image.convert("RGBA").save(png, "PNG")
    except (OSError, SyntaxError, Image.DecompressionBombError) as error:
        raise ValueError(f"the TIFF file cannot be read: {error}") from error
    return png.getvalue()


def _without_pillow(path: str) -> str:
    """Return what to install for a TIFF file; empty if nothing is missing."""
    if not path.lower().endswith(_TIFF) or find_spec("PIL") is not None:
        return ""
    return f"'{path}' needs Pillow: pip install 'turtlewire-view[tiff]'"


def _address(uri: str, package: str, path: str, folder: str | None, texture: bool) -> MeshAddress:
    problem = _problem(package, path)
    if not problem:
        suffix = os.path.splitext(path)[1].lower()
        if texture and not MEDIA_TYPES.get(suffix, "").startswith("image/"):
            problem = f"'{path}' is not an image that browsers can show"
        elif not texture and suffix not in _MESHES:
            problem = f"'{path}' is not a mesh that the page can read ({', '.join(_MESHES)})"
    problem = problem or _missing(package, path, _file_in(folder, path)) or _without_pillow(path)
    if problem or folder is None:
        return MeshAddress(None, f"'{uri}' is not loaded: {problem}")
    return MeshAddress(_PREFIX + package + "/" + quote(path), "", ((package, folder),))


def _problem(package: str, path: str) -> str:
    """Return why a file with this name is not served, or an empty string."""
    if not PACKAGE_NAME.fullmatch(package):
        return f"'{package}' is not the name of a package"
    parts = path.split("/")
    if any(part in {"", ".", ".."} for part in parts):
        return f"the path '{path}' does not stay below the package"
    if any(letter in path for letter in "\\\0:") or any(part.startswith(".") for part in parts):
        return f"the path '{path}' holds a name that is not served"
    return ""


def _file_in(folder: str | None, path: str) -> str:
    """Return the path of a package's file; empty if the package does not exist."""
    return "" if folder is None else os.path.join(folder, *path.split("/"))


def _missing(package: str, path: str, file: str) -> str:
    """Return why a file cannot be served, or an empty string."""
    if not file:
        return (
            f"there is no package '{package}' in AMENT_PREFIX_PATH; to say where it is, start with "
            f"--package {package}=FOLDER"
        )
    if not os.path.isfile(file):
        return f"the package '{package}' has no file '{path}'"
    try:
        with open(file, "rb") as opened:
            opened.read(1)  # a file that can be opened may still give an I/O error
            size = opened.seek(0, os.SEEK_END)
    except OSError as error:
        return f"the file '{path}' of the package '{package}' cannot be read: {error.strerror}"
    if size > _LARGEST_FILE:
        return f"'{path}' is larger than {_LARGEST_FILE // 2**20} MiB"
    return ""
