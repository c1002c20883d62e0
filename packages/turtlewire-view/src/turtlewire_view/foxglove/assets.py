"""Files of packages, such as the meshes of a robot."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING
from urllib.parse import unquote

if TYPE_CHECKING:
    from turtlewire_view.foxglove.options import Patterns

__all__ = ["AssetError", "read_asset", "share_folder"]

_SCHEME = "package://"
#: Largest file that is sent [bytes].
_LARGEST = 256 << 20
_LONGEST_URI = 4096


class AssetError(Exception):
    """A file cannot be served; the text says why."""


def share_folder(package: str) -> str | None:
    """The share folder of a package in the prefixes of ``AMENT_PREFIX_PATH``, or in this one."""
    prefixes = [*os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep), sys.prefix]
    folders = (os.path.join(prefix, "share", package) for prefix in prefixes if prefix)
    return next((folder for folder in folders if os.path.isdir(folder)), None)


def read_asset(uri: str, allowed: Patterns, find_share: Callable[[str], str | None]) -> bytes:
    """Return the file of a ``package://PACKAGE/PATH`` address.

    Nothing outside of the package's share folder is read, except what links in it point to:
    ``colcon build --symlink-install`` makes such links.

    Args:
        uri: The address; ``%20`` and the like stand for other characters.
        allowed: Which addresses may be read.
        find_share: Returns the share folder of a package.

    Raises:
        AssetError: The address is not allowed, or there is no such file.
    """
    if len(uri) > _LONGEST_URI:
        raise AssetError(f"an address of {len(uri)} characters is too long")
    if not uri.startswith(_SCHEME):
        raise AssetError(f"only package:// addresses are served, not {uri}")
    if not allowed.match(uri):
        raise AssetError(f"asset_uri_allowlist does not allow {uri}")
    package, *parts = unquote(uri.removeprefix(_SCHEME)).split("/")
    if not _is_plain(package) or not parts or not all(map(_is_plain, parts)):
        raise AssetError(f"{uri} leads out of a package")
    folder = find_share(package)
    if folder is None:
        raise AssetError(f"there is no package '{package}' in AMENT_PREFIX_PATH")
    return _content(os.path.join(folder, *parts), uri)


def _is_plain(part: str) -> bool:
    """Return True if this is the name of a file or folder, and no way to another one."""
    return part not in {"", ".", ".."} and not any(letter in part for letter in "/\\\0:")


def _content(path: str, uri: str) -> bytes:
    if not os.path.isfile(path):  # a pipe or a device would never end
        raise AssetError(f"there is no file {uri}")
    try:
        with open(path, "rb") as file:
            content = file.read(_LARGEST + 1)
    except OSError as error:
        raise AssetError(f"{uri} cannot be read: {error.strerror}") from error
    if len(content) > _LARGEST:
        raise AssetError(f"{uri} is larger than {_LARGEST >> 20} MB")
    return content
