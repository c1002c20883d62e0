"""Interactive markers: the set that a server offers, and its changes."""

from __future__ import annotations

from collections import deque
from dataclasses import replace
from itertools import count
from typing import TYPE_CHECKING, Any

from turtlewire_view.displays.content import (
    Content,
    Display,
    Output,
    Removal,
    UnusableMessageError,
    frame_of,
    stamp_ns_of,
)
from turtlewire_view.displays.interactive_marker import interactive_marker_content
from turtlewire_view.displays.numeric import finite_pose

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["InteractiveMarkersDisplay"]

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
