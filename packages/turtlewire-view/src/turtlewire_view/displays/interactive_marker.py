"""One interactive marker as a header and arrays for the page."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from turtlewire.geometry import quaternions
from turtlewire_view.displays.content import (
    Content,
    UnusableMessageError,
    frame_of,
    stamp_ns_of,
)
from turtlewire_view.displays.marker import packed_shapes
from turtlewire_view.displays.marker_shapes import marker_shape
from turtlewire_view.displays.numeric import LARGEST, finite_pose, pose_rows

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire_view.displays.marker_shapes import MarkerShape
    from turtlewire_view.package_folders import PackageFolders

__all__ = ["INTERACTION_MODES", "interactive_marker_content"]

#: Names of the modes of controls, by number.
INTERACTION_MODES = (
    "none",
    "menu",
    "button",
    "move_axis",
    "move_plane",
    "rotate_axis",
    "move_rotate",
    "move_3d",
    "rotate_3d",
    "move_rotate_3d",
)
_ORIENTATION_MODES = ("inherit", "fixed", "view_facing")
_MOST_ENTRIES = 1000
_LONGEST_TEXT = 1000


def interactive_marker_content(
    message: Any,
    most_controls: int,
    budget: int,
    warn: Callable[[str], None],
    folders: PackageFolders,
) -> Content:
    """Return an InteractiveMarker, as a part with its name in the marker's frame.

    Missing sizes and rotations get the defaults of ROS 2's ``interactive_markers``. The header has
    ``pose``, ``scale``, ``description``, ``menu`` (``id``, ``parent``, ``title``, ``runs``), and
    ``controls``: ``name``, ``mode``, ``orientation``, ``turn`` (xyzw), ``independent``,
    ``description`` and ``markers``, whose poses are relative to the marker.

    Args:
        message: The message.
        most_controls: How many of its controls may be drawn.
        budget: How many points may be sent.
        warn: Gets what is not drawn as sent.
        folders: Where packages with meshes lie.

    Raises:
        UnusableMessageError: The marker has no frame, or a number is not finite.
    """
    frame_id, stamp_ns = frame_of(message), stamp_ns_of(message)
    pose = finite_pose(message.pose, warn)
    scale = float(message.scale)
    if not 0 <= scale < LARGEST:
        raise UnusableMessageError(f"the scale {scale} cannot be drawn")
    if len(message.controls) > most_controls:
        warn(f"{most_controls} of {len(message.controls)} controls are drawn")
    shapes: list[MarkerShape] = []
    controls = []
    for control in message.controls[:most_controls]:
        own = _shapes_of(control, frame_id, pose, budget, warn, folders)
        budget -= sum(len(shape.points) for shape in own)
        controls.append((_header_of(control, warn), len(own)))
        shapes += own
    headers, arrays, packages = packed_shapes(shapes)
    rest = iter(headers)
    header = {
        "pose": pose,
        "scale": scale or 1.0,
        "description": message.description[:_LONGEST_TEXT],
        "menu": _menu_of(message.menu_entries, warn),
        "controls": [
            {**each, "markers": [next(rest) for _ in range(count)]} for each, count in controls
        ],
    }
    locked = stamp_ns == 0
    part = message.name
    return Content(header, arrays, frame_id, stamp_ns, part, locked=locked, packages=packages)


def _header_of(control: Any, warn: Callable[[str], None]) -> dict[str, Any]:
    turn = control.orientation
    rows, kept = pose_rows([(0.0, 0.0, 0.0, turn.x, turn.y, turn.z, turn.w)])
    if not kept[0]:
        warn(f"control '{control.name}': the orientation is not finite, so it is not turned")
    mode, facing = control.interaction_mode, control.orientation_mode
    if mode >= len(INTERACTION_MODES):
        warn(f"control '{control.name}': the interaction mode {mode} is unknown")
    if facing >= len(_ORIENTATION_MODES):
        warn(f"control '{control.name}': the orientation mode {facing} is unknown")
    return {
        "name": control.name,
        "mode": INTERACTION_MODES[mode] if mode < len(INTERACTION_MODES) else "none",
        "orientation": _ORIENTATION_MODES[facing if facing < len(_ORIENTATION_MODES) else 0],
        "turn": rows[0][3:].tolist() if kept[0] else [0.0, 0.0, 0.0, 1.0],
        "independent": bool(control.independent_marker_orientation),
        "description": control.description[:_LONGEST_TEXT],
    }


def _shapes_of(
    control: Any,
    frame_id: str,
    pose: list[float],
    budget: int,
    warn: Callable[[str], None],
    folders: PackageFolders,
) -> list[MarkerShape]:
    shapes = []
    for marker in control.markers:
        for axis in "xyz":
            if getattr(marker.scale, axis) == 0:
                setattr(marker.scale, axis, 1.0)
        try:
            shape = marker_shape(marker, max(1, budget), warn, folders)
            if marker.header.frame_id:
                _require_same_frame(marker, frame_id)
                shape.header["pose"] = _relative(pose, shape.header["pose"])
        except UnusableMessageError as error:
            warn(f"control '{control.name}': {error}")
            continue
        budget -= len(shape.points)
        shapes.append(shape)
    return shapes


def _require_same_frame(marker: Any, frame_id: str) -> None:
    if marker.header.frame_id != frame_id:
        raise UnusableMessageError(
            f"a marker in the frame '{marker.header.frame_id}' is left out; its frame must be "
            f"empty or '{frame_id}'"
        )


def _relative(pose: list[float], other: list[float]) -> list[float]:
    """Return ``other`` as seen from ``pose``; both are x, y, z, qx, qy, qz, qw."""
    back = quaternions.conjugate(pose[3:])
    x, y, z = (b - a for a, b in zip(pose[:3], other[:3], strict=True))
    return [*quaternions.rotate(back, (x, y, z)), *quaternions.multiply(back, other[3:])]


def _menu_of(entries: Any, warn: Callable[[str], None]) -> list[dict[str, Any]]:
    if len(entries) > _MOST_ENTRIES:
        warn(f"{_MOST_ENTRIES} of {len(entries)} menu entries are shown")
    shown: dict[int, dict[str, Any]] = {}
    for entry in entries[:_MOST_ENTRIES]:
        if entry.id in shown:
            warn(f"two menu entries have the id {entry.id}; the first one is shown")
            continue
        shown[int(entry.id)] = {
            "id": int(entry.id),
            "parent": int(entry.parent_id),
            "title": entry.title[:_LONGEST_TEXT],
            "runs": entry.command[:_LONGEST_TEXT] if entry.command_type else "",
        }
    return list(shown.values())
