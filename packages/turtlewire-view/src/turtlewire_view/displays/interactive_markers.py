"""Interactive markers: the set that a server offers, and its changes."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import replace
from itertools import count
from typing import TYPE_CHECKING, Any

from turtlewire.geometry import quaternions
from turtlewire_view.displays.content import (
    Content,
    Display,
    Output,
    Removal,
    UnusableMessageError,
    frame_of,
    stamp_ns_of,
)
from turtlewire_view.displays.marker import packed_shapes
from turtlewire_view.displays.marker_shapes import marker_shape
from turtlewire_view.displays.numeric import LARGEST, finite_pose, pose_rows

if TYPE_CHECKING:
    from turtlewire_view.displays.marker_shapes import MarkerShape
    from turtlewire_view.package_folders import PackageFolders

__all__ = [
    "INTERACTION_MODES",
    "InteractiveMarkersDisplay",
    "interactive_marker_content",
]

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


_UPDATE, _GET = "/update", "/get_interactive_markers"
_GET_TYPE = "visualization_msgs/srv/GetInteractiveMarkers"
_FEEDBACK_TYPE = "visualization_msgs/msg/InteractiveMarkerFeedback"
_KEEP_ALIVE = 0
_MOST_CONTROLS = 1000
_MOST_MARKERS = 1000
#: Updates that may be newer than a response.
_MOST_RECENT = 100


class InteractiveMarkersDisplay(Display):
    """The markers of a server, each as a part with its name.

    The topic is ``NAMESPACE/update``. A service gives the markers that there are; the display asks
    it again when the numbers of updates have a gap. Options are the page's. The header of each
    marker has a ``revision``: the page keeps what it has made of a marker with the same one.
    """

    kind = "interactive_markers"

    def __init__(self, options: Mapping[str, object] | None = None, **keywords: Any) -> None:
        super().__init__(options, **keywords)
        self._contents: dict[str, Content] = {}
        self._revisions = count()
        self._number: int | None = None  # of the last update
        self._recent: deque[Any] = deque(maxlen=_MOST_RECENT)
        self._problem = f"The markers that exist already are not known yet: {_GET} has not answered"

    @property
    def service(self) -> tuple[str, str] | None:
        """Name and type of the service that gives all markers."""
        return self._namespace + _GET, _GET_TYPE

    @property
    def sends(self) -> tuple[str, str] | None:
        """Topic and message type of the feedback."""
        return self._namespace + "/feedback", _FEEDBACK_TYPE

    def marker(self, name: str) -> Content | None:
        """Return a marker as the page has it; for any thread."""
        return self._contents.get(name)

    def take(self, topic: str, message: Any) -> list[Output]:
        """Return the markers of an update, or of the service's response."""
        if topic == self.topic:
            return self.content(message)
        return self._answer(lambda: self._begin(message))

    def take_problem(self, text: str) -> list[Output]:
        """Return the status when the service cannot be called."""
        self._problem = f"Only changed markers are shown: {text}"
        return self._answer(list)

    @property
    def _namespace(self) -> str:
        return self.topic.removesuffix(_UPDATE)

    def _answer(self, make: Any) -> list[Output]:
        def outputs() -> list[Output]:
            made: list[Output] = make()
            if self._problem:
                self.warn(self._problem)
            return made

        return super()._answer(outputs)

    def _begin(self, response: Any) -> list[Output]:
        """Return all markers of the server, and later updates that have come already."""
        self._problem = ""
        there = {marker.name for marker in response.markers}
        outputs = self._erase([name for name in self._contents if name not in there])
        outputs += self._insert(response.markers)
        self._number = int(response.sequence_number)
        later = [each for each in self._recent if each.seq_num > self._number]
        self._recent.clear()
        for update in later:
            outputs += self._changes(update)
            self._number = int(update.seq_num)
        return outputs

    def _outputs(self, message: Any) -> list[Output]:
        """Return what an update changes."""
        number = int(message.seq_num)
        is_next = message.type != _KEEP_ALIVE
        expected = None if self._number is None else self._number + is_next
        if expected is not None and number != expected:  # one is missing, or the server is another
            self._recent.clear()
            self.asks_again = True
        self._number = number
        if not is_next:
            return []
        self._recent.append(message)
        return self._changes(message)

    def _changes(self, update: Any) -> list[Output]:
        outputs = self._insert(update.markers)
        for each in update.poses:
            outputs += self._move(each)
        return outputs + self._erase(update.erases)

    def _insert(self, markers: Any) -> list[Output]:
        outputs: list[Output] = []
        for marker in markers:
            name = marker.name
            self._contents.pop(name, None)
            outputs.append(Removal(name))
            if len(self._contents) >= _MOST_MARKERS:
                self.warn(f"there are {_MOST_MARKERS} markers already, so '{name}' is left out")
                continue
            drawn = sum(len(each.header["controls"]) for each in self._contents.values())
            try:
                content = interactive_marker_content(
                    marker, max(0, _MOST_CONTROLS - drawn), self.budget, self.warn, self.packages
                )
            except UnusableMessageError as error:
                self.warn(f"marker '{name}': {error}")
                continue
            content.header["revision"] = next(self._revisions)
            self._contents[name] = content
            outputs[-1] = content
        return outputs

    def _move(self, update: Any) -> list[Output]:
        content = self._contents.get(update.name)
        if content is None:
            return []
        try:
            header = {**content.header, "pose": finite_pose(update.pose, self.warn)}
            frame_id, stamp_ns = frame_of(update), stamp_ns_of(update)
        except UnusableMessageError as error:
            self.warn(f"marker '{update.name}': {error}")
            return []
        locked = stamp_ns == 0
        moved = replace(content, header=header, frame_id=frame_id, stamp_ns=stamp_ns, locked=locked)
        self._contents[update.name] = moved
        return [moved]

    def _erase(self, names: Any) -> list[Output]:
        return [Removal(name) for name in list(names) if self._contents.pop(name, None)]
