"""The image on a TRIANGLE_LIST, and the texture coordinates of each corner."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from turtlewire_view.displays.content import UnusableMessageError
from turtlewire_view.displays.numeric import picked_rows, rows_within
from turtlewire_view.meshes import mesh_address

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from turtlewire_view.package_folders import PackageFolders

__all__ = ["MarkerTexture", "marker_texture"]

_EMBEDDED = "embedded://"
_LARGEST_FILE = 32 * 2**20


class MarkerTexture(NamedTuple):
    """The data of a texture that the page gets.

    Attributes:
        header: ``name``, and ``url`` or ``problem`` unless the image travels along; None: no
            texture.
        uv: ``(n, 2)``, for each point u to the right and v down, of the image's size.
        file: The encoded image, or none.
        packages: Names and folders of packages whose images it needs.
    """

    header: dict[str, str] | None
    uv: NDArray[np.float32]
    file: NDArray[np.uint8]
    packages: tuple[tuple[str, str], ...]


_NONE = MarkerTexture(None, np.empty((0, 2), np.float32), np.empty(0, np.uint8), ())


def marker_texture(
    marker: Any,
    picked: NDArray[np.intp],
    warn: Callable[[str], None],
    folders: PackageFolders,
) -> MarkerTexture:
    """Return the texture of a TRIANGLE_LIST.

    Args:
        marker: The message.
        picked: Which of its points are drawn.
        warn: Called with the reason if the named texture is missing.
        folders: Where packages with images lie.

    Raises:
        UnusableMessageError: The image is too large.
    """
    name, data = marker.texture_resource, marker.texture.data
    if not name:
        if len(marker.uv_coordinates) or len(data):
            warn("texture_resource is empty: the triangles have no texture")
        return _NONE
    points, coordinates = len(marker.points), len(marker.uv_coordinates)
    if coordinates != points:
        warn(f"{coordinates} uv_coordinates for {points} points: the texture is not drawn")
        return _NONE
    uv = picked_rows(marker.uv_coordinates, picked, "uv")
    uv[~rows_within(uv)] = 0.0
    if name.startswith(_EMBEDDED):
        if not len(data):
            warn(f"'{name}' is not drawn: the field texture of this message is empty")
            return _NONE
        if len(data) > _LARGEST_FILE:
            raise UnusableMessageError(f"the embedded texture of {len(data)} bytes is too large")
        image = np.array(data, dtype=np.uint8)
        return MarkerTexture({"name": name}, uv.astype(np.float32), image, ())
    address = mesh_address(name, folders, texture=True)
    if address.problem:
        warn(address.problem)
        return _NONE
    header = {"name": name, **address.header()}
    return MarkerTexture(header, uv.astype(np.float32), _NONE.file, address.packages)
