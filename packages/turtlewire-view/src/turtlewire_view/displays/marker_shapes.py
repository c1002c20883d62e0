"""Converts a Marker message to shapes of the page, with RViz's checks."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from turtlewire.wording import counted
from turtlewire_view.displays.content import UnusableMessageError
from turtlewire_view.displays.numeric import (
    LARGEST,
    color_bytes,
    finite_points,
    finite_pose,
    picked_rows,
    rgba_bytes,
    rows_within,
    spread,
)
from turtlewire_view.meshes import mesh_address

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlewire_view.package_folders import PackageFolders

__all__ = [
    "MARKER_TYPES",
    "MarkerShape",
    "MarkerTexture",
    "marker_shape",
    "marker_texture",
]

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
        given = counted(coordinates, "uv_coordinate")
        warn(f"{given} for {counted(points, 'point')}: the texture is not drawn")
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


#: Marker types by number.
MARKER_TYPES = (
    "arrow",
    "cube",
    "sphere",
    "cylinder",
    "line_strip",
    "line_list",
    "cube_list",
    "sphere_list",
    "points",
    "text",
    "mesh",
    "triangle_list",
    "arrow_strip",
)
#: Least number of points, and of how many each item consists.
_GROUPS = {
    "line_strip": (2, 1),
    "line_list": (2, 2),
    "cube_list": (1, 1),
    "sphere_list": (1, 1),
    "points": (1, 1),
    "triangle_list": (3, 3),
    "arrow_strip": (2, 1),
}
#: Items of which some may be omitted evenly if there are too many; lines are truncated instead.
_THINNED = frozenset({"cube_list", "sphere_list", "points", "line_list", "triangle_list"})
_LONGEST_TEXT = 10_000


class MarkerShape(NamedTuple):
    """The data of a marker that the page gets.

    Attributes:
        header: Shape, pose, scale, colour and what else the shape needs.
        points: ``(n, 3)``, relative to the marker's pose.
        colors: ``(n, 4)``, one for each point, or none.
        file: The bytes of an embedded mesh or texture, or none.
        packages: Names and folders of packages whose meshes and textures it needs.
        uv: ``(n, 2)``, where each point lies in the texture, or none.
    """

    header: dict[str, Any]
    points: NDArray[np.float32]
    colors: NDArray[np.uint8]
    file: NDArray[np.uint8]
    packages: tuple[tuple[str, str], ...]
    uv: NDArray[np.float32]


def marker_shape(
    marker: Any, budget: int, warn: Callable[[str], None], folders: PackageFolders
) -> MarkerShape:
    """Return the shape of a Marker whose action is ADD.

    Args:
        marker: The message.
        budget: How many points may be sent.
        warn: Gets what is wrong with it but can be drawn, or is invisible.
        folders: Where packages with meshes lie.

    Raises:
        UnusableMessageError: The marker cannot be drawn.
    """
    if not 0 <= marker.type < len(MARKER_TYPES):
        raise UnusableMessageError(f"the type {marker.type} is unknown (0 to 12 are known)")
    shape = MARKER_TYPES[marker.type]
    header: dict[str, Any] = {
        "shape": shape,
        "pose": finite_pose(marker.pose, warn if shape != "text" else _ignore),
        "scale": _scale_of(marker, shape, warn),
        "color": rgba_bytes(marker.color),
    }
    points, colors = np.empty((0, 3), np.float32), np.empty((0, 4), np.uint8)
    file, uv = np.empty(0, np.uint8), np.empty((0, 2), np.float32)
    packages: tuple[tuple[str, str], ...] = ()
    if shape in _GROUPS or (shape == "arrow" and len(marker.points)):
        picked, points, colors = _points(marker, shape, budget, warn)
        if shape == "triangle_list":
            texture = marker_texture(marker, picked, warn, folders)
            header["texture"], uv, file, packages = texture
    elif shape == "text":
        header["text"] = marker.text[:_LONGEST_TEXT]
        if not marker.text.strip():
            warn("the text is empty")
    elif shape == "mesh":
        file, packages = _mesh(marker, header, warn, folders)
    if not header["color"][3] and not len(colors) and not header.get("embedded_materials"):
        warn("the marker is invisible: color.a is 0")
    return MarkerShape(header, points, colors, file, packages, uv)


def _ignore(_: str) -> None:
    """A text faces the camera: its orientation does not matter."""


def _scale_of(marker: Any, shape: str, warn: Callable[[str], None]) -> list[float]:
    scale = [float(marker.scale.x), float(marker.scale.y), float(marker.scale.z)]
    if not all(abs(value) < LARGEST for value in scale):
        raise UnusableMessageError(f"the scale {scale} is not finite or too large")
    if shape in {"line_strip", "line_list"}:
        needed = scale[:1]
    elif shape == "text":
        needed = scale[2:]
    elif shape == "points" or (shape == "arrow" and len(marker.points)) or shape == "arrow_strip":
        needed = scale[:2]
    else:
        needed = scale
    if not all(needed):
        warn(f"the scale {tuple(scale)} has a 0 that makes the {shape} invisible")
    return scale


def _points(
    marker: Any, shape: str, budget: int, warn: Callable[[str], None]
) -> tuple[NDArray[np.intp], NDArray[np.float32], NDArray[np.uint8]]:
    """Return the indices, positions and own colours of the points to draw."""
    count, colors = len(marker.points), len(marker.colors)
    least, group = _GROUPS.get(shape, (2, 1))
    if count < least:
        raise UnusableMessageError(f"{shape}: {counted(count, 'point')}, but it needs {least}")
    if count % group:
        warn(f"{count} points; a {shape} needs a multiple of {group}, the rest is left out")
    per_group = shape == "triangle_list" and colors == count // group
    if colors and colors != count and not per_group:
        warn(
            f"{counted(colors, 'color')} for {counted(count, 'point')}: all get the marker's color"
        )
    picked = _picked(shape, count - count % group, group, budget)
    if len(picked) < count - count % group:
        warn(f"{len(picked)} of {count} points are drawn")
    points = finite_points(picked_rows(marker.points, picked, "xyz"))
    finite = rows_within(points)
    if group > 1:
        finite = np.repeat(finite.reshape(-1, group).all(axis=1), group)
    if not finite.all():
        warn(f"{np.count_nonzero(~finite)} of {count} points are left out: not finite")
        picked, points = picked[finite], points[finite]
    if colors != count and not per_group:
        return picked, points.astype(np.float32), np.empty((0, 4), np.uint8)
    own = picked // group if per_group else picked
    rgba = color_bytes(picked_rows(marker.colors, own, "rgba"))
    return picked, points.astype(np.float32), rgba


def _picked(shape: str, count: int, group: int, budget: int) -> NDArray[np.intp]:
    """Return the indices of the points to draw."""
    if shape in _THINNED:
        items = spread(count // group, max(1, budget // group))
        return (items[:, None] * group + np.arange(group)).reshape(-1)
    return np.arange(min(count, budget))


def _mesh(
    marker: Any, header: dict[str, Any], warn: Callable[[str], None], folders: PackageFolders
) -> tuple[NDArray[np.uint8], tuple[tuple[str, str], ...]]:
    header["embedded_materials"] = bool(marker.mesh_use_embedded_materials)
    data = marker.mesh_file.data
    if len(data):
        if len(data) > _LARGEST_FILE:
            raise UnusableMessageError(f"the embedded mesh of {len(data)} bytes is too large")
        header["mesh"] = {"name": marker.mesh_file.filename or marker.mesh_resource}
        return np.array(data, dtype=np.uint8), ()
    if not marker.mesh_resource:
        raise UnusableMessageError("mesh_resource is empty")
    address = mesh_address(marker.mesh_resource, folders)
    if address.problem:
        warn(address.problem)
    header["mesh"] = {"name": marker.mesh_resource, **address.header()}
    return np.empty(0, np.uint8), address.packages
