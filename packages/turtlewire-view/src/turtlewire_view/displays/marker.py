"""Marker and MarkerArray: the markers by namespace and id, and their lifetimes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from turtlewire_view.displays.content import (
    Content,
    Display,
    Output,
    Removal,
    UnusableMessageError,
    frame_of,
    stamp_ns_of,
)
from turtlewire_view.displays.marker_shapes import marker_shape

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlewire_view.displays.marker_shapes import MarkerShape

__all__ = ["MarkerDisplay", "packed_shapes"]

_Key: TypeAlias = tuple[str, int]
_Place: TypeAlias = tuple[str, int, bool]

_ADD, _DELETE, _DELETEALL = 0, 2, 3
#: More markers than this at once would fill the page's memory.
_MOST_MARKERS = 50_000
_LONGEST_LIFETIME = 1e9


class _Held(NamedTuple):
    """A marker that the page shows: in which part, and until when on the display's clock."""

    part: str
    expires_ns: int | None


class MarkerDisplay(Display):
    """Markers of ``visualization_msgs/msg/Marker`` and ``MarkerArray``.

    Markers of one message that share frame, stamp and ``frame_locked`` travel as one part: the
    header's ``markers`` say what each is and which rows of ``points``, ``colors``, ``uv`` and
    ``files`` are its own. ``clear`` and ``delete`` (pairs of namespace and id) are events. A marker
    replaces the one with its namespace and id, in whichever part that is. The page counts
    lifetimes.
    """

    kind = "marker"
    reads_rows = True

    def __init__(self, options: Mapping[str, object] | None = None, **keywords: Any) -> None:
        super().__init__(options, **keywords)
        self._held: dict[_Key, _Held] = {}
        self._sizes: dict[str, int] = {}  # markers in each part

    def _outputs(self, message: Any) -> list[Output]:
        markers = message.markers if hasattr(message, "markers") else [message]
        self._forget_expired()
        outputs: list[Output] = []
        groups: dict[_Place, dict[_Key, tuple[Any, MarkerShape]]] = {}
        budget = self.budget
        added: set[_Key] = set()
        new: set[_Key] = set()  # drawn by this message and not held before
        for marker in markers:
            key = (marker.ns, marker.id)
            if marker.action == _DELETEALL:
                groups.clear()
                added.clear()
                new.clear()
                for held in list(self._held):
                    self._forget(held)
                outputs = [Content({"clear": True}, event=True)]
            elif marker.action == _DELETE:
                added.discard(key)
                new.discard(key)
                for group in groups.values():
                    group.pop(key, None)
                if self._forget(key):
                    outputs.append(Content({"delete": [list(key)]}, event=True))
            elif marker.action == _ADD:
                if key in added:
                    self.warn(
                        "Multiple Markers in the same MarkerArray message had the same ns and id: "
                        f"({marker.ns}, {marker.id})"
                    )
                added.add(key)
                budget -= self._add(marker, groups, new, budget)
            else:
                self.warn(f"marker {_named(key)}: the action {marker.action} is unknown")
        outputs += [self._part(place, group) for place, group in groups.items() if group]
        return [*outputs, *self._empty_parts()]

    def _add(
        self,
        marker: Any,
        groups: dict[_Place, dict[_Key, tuple[Any, MarkerShape]]],
        new: set[_Key],
        budget: int,
    ) -> int:
        """Put a marker into the group of its place; returns how many points it has."""
        key = (marker.ns, marker.id)

        def warn(text: str) -> None:
            self.warn(f"marker {_named(key)}: {text}")

        is_new = key not in self._held and key not in new
        if is_new and len(self._held) + len(new) >= _MOST_MARKERS:
            warn(f"there are {_MOST_MARKERS} markers already")
            return 0
        try:
            place = (frame_of(marker), stamp_ns_of(marker), bool(marker.frame_locked))
            shape = marker_shape(marker, max(1, budget), warn, self.packages)
        except UnusableMessageError as error:
            warn(str(error))
            return 0
        for group in groups.values():
            group.pop(key, None)
        groups.setdefault(place, {})[key] = (marker, shape)
        if is_new:
            new.add(key)
        return len(shape.points)

    def _part(self, place: _Place, group: dict[_Key, tuple[Any, MarkerShape]]) -> Content:
        frame_id, stamp_ns, locked = place
        part = str(next(self._numbers))
        headers, arrays, packages = packed_shapes([shape for _, shape in group.values()])
        entries = []
        for (key, (marker, _)), own in zip(group.items(), headers, strict=True):
            lifetime = _lifetime(marker)
            self._hold(key, part, lifetime)
            entries.append({"key": list(key), "lifetime": lifetime, **own})
        header = {"markers": entries}
        return Content(header, arrays, frame_id, stamp_ns, part, locked=locked, packages=packages)

    def _hold(self, key: _Key, part: str, lifetime: float) -> None:
        self._forget(key)
        expires = self._clock() + int(lifetime * 1e9) if lifetime else None
        self._held[key] = _Held(part, expires)
        self._sizes[part] = self._sizes.get(part, 0) + 1

    def _forget(self, key: _Key) -> bool:
        held = self._held.pop(key, None)
        if held is not None:
            self._sizes[held.part] -= 1
        return held is not None

    def _forget_expired(self) -> None:
        now = self._clock()
        for key, held in list(self._held.items()):
            if held.expires_ns is not None and held.expires_ns < now:
                self._forget(key)

    def _empty_parts(self) -> list[Output]:
        empty = [part for part, size in self._sizes.items() if not size]
        for part in empty:
            del self._sizes[part]
        return [Removal(part) for part in empty]


def _named(key: _Key) -> str:
    return f"{key[0]}/{key[1]}"


def _lifetime(marker: Any) -> float:
    """Seconds; 0 or a negative number sets no limit."""
    seconds = int(marker.lifetime.sec) + int(marker.lifetime.nanosec) * 1e-9
    return min(max(0.0, seconds), _LONGEST_LIFETIME)


_NAMES = ("points", "colors", "file", "uv")


def packed_shapes(
    shapes: Sequence[MarkerShape],
) -> tuple[list[dict[str, Any]], dict[str, NDArray[Any]], tuple[tuple[str, str], ...]]:
    """Return headers with ``[first, count]`` of the rows of each array, the arrays, and packages.

    Args:
        shapes: The markers.
    """
    offsets = dict.fromkeys(_NAMES, 0)
    headers = []
    for shape in shapes:
        ranges = {name: [offsets[name], len(getattr(shape, name))] for name in _NAMES}
        headers.append({**shape.header, **ranges})
        offsets = {name: sum(ranges[name]) for name in _NAMES}
    if not shapes:
        return [], {}, ()
    arrays = {
        "points": np.concatenate([shape.points for shape in shapes]),
        "colors": np.concatenate([shape.colors for shape in shapes]),
        "files": np.concatenate([shape.file for shape in shapes]),
        "uv": np.concatenate([shape.uv for shape in shapes]),
    }
    packages = tuple(sorted({each for shape in shapes for each in shape.packages}))
    return headers, arrays, packages
