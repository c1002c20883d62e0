"""One display of one page: messages of a topic in, packets out, each where its frame was then.

A message is shown when its frame can be transformed into the fixed frame at its stamp, as in tf2's
message filter: a message that arrives before its transforms waits for them, one that is older than
all of them is dropped, and if too many wait, the oldest is dropped. The status gives the reason.
"""

from __future__ import annotations

import logging
import threading
from collections import deque
from collections.abc import Callable, Mapping
from itertools import count
from typing import TYPE_CHECKING, Any, TypeAlias

from turtlewire import msg
from turtlewire.errors import CdrError, ExtrapolationException, TransformException
from turtlewire.web.packets import encode_packet
from turtlewire_view.displays.content import Content, Removal, Status

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlewire_view.displays.content import Display, Output
    from turtlewire_view.frames import Base
    from turtlewire_view.source import ParameterAnswer, ServiceAnswer, ServiceCalls

    AskService: TypeAlias = Callable[[str, str, Callable[[ServiceAnswer], None]], ServiceCalls]
    Ask: TypeAlias = Callable[[str, str, Callable[[ParameterAnswer], None]], Callable[[], None]]

__all__ = ["DisplayFeed"]

_logger = logging.getLogger(__name__)
_MOST_MESSAGES = 1000
_MOST_WAITING = 50
_MOST_EVENTS = 1000
#: As RViz has it until the first message comes.
_NO_MESSAGE = Status("warn", "No messages received")


class DisplayFeed:
    """Messages come in on any thread; one thread calls :meth:`work`, another one takes packets.

    Attributes:
        ask: Asks for a parameter, as :meth:`turtlewire_view.source.Source.ask_parameter`.
        ends: What :meth:`close` calls.
        on_packages: Gets names and folders of packages whose files the page will ask for.
        types: Message types by topic.

    Args:
        name: The page's name of the display.
        display: Makes geometry of messages.
        types: Message types by topic.
        on_work: Called when :meth:`work` should be called; on the threads that bring messages.
        on_packets: Called when there are packets to take; on the thread of :meth:`work`.
    """

    def __init__(
        self,
        name: str,
        display: Display,
        types: Mapping[str, str],
        on_work: Callable[[DisplayFeed], None],
        on_packets: Callable[[], None],
    ) -> None:
        self.name = name
        self.display = display
        self.types = types
        self.paused = False
        self._classes = {topic: msg.get_message(each) for topic, each in types.items()}
        self._on_work, self._on_packets = on_work, on_packets
        self._lock = threading.Lock()
        # Topic, or service, and CDR bytes; the service with a string if it cannot be called.
        self._inbox: deque[tuple[str, bytes | str]] = deque(maxlen=_MOST_MESSAGES)
        self._calls: ServiceCalls | None = None
        self._waiting: deque[Content] = deque()
        self._shown: dict[str, Content] = {}
        self._base: Base | None = None
        self._starts = True
        self._has_message = False
        self._last: dict[str, bytes] = {}  # topic to message, for displays that show it again
        self._ready: dict[str, bytes] = {}
        self._told: set[str] = set()  # parts that the page has
        self._status: Status | None = None
        self._own_status = Status("ok", "")
        self._logged = False
        self._events = count()
        self._said: Status | None = None
        self._asks: tuple[str, str] | None = None
        self._end_asking: Callable[[], None] | None = None
        self._answer: ParameterAnswer | None = None
        self.ask: Ask | None = None
        self.ends: list[Callable[[], None]] = []
        self.on_packages: Callable[[tuple[tuple[str, str], ...]], None] = _nothing

    @property
    def waits(self) -> bool:
        """True if new transforms may make something visible."""
        return bool(self._waiting)

    @property
    def needs_other_topics(self) -> bool:
        """True if the current options need other topics than the feed subscribes to."""
        return self.display.topics(self.types.get(self.display.topic, "")) != self.types

    def take_message(self, topic: str, cdr: bytes) -> None:
        """Take a message of a topic; for any thread."""
        if not self.paused:
            self._inbox.append((topic, cdr))
            self._on_work(self)

    def set_options(self, options: Mapping[str, object]) -> None:
        """Take the user's choices; for the thread of the page's commands."""
        self.display.set_options(options)
        self._starts = True
        self._inbox.extend(list(self._last.items()))
        self.follow_parameter()
        self._on_work(self)

    def follow_parameter(self) -> None:
        """Ask for the parameter that the display wants now; for the thread of commands."""
        wanted = self.display.parameter
        if self.ask is None or wanted == self._asks:
            return
        if self._end_asking is not None:
            self._end_asking()
        self._asks, self._answer, self._end_asking = wanted, None, None
        if wanted is not None:
            self._end_asking = self.ask(*wanted, self._take_answer)

    def call_service(self, ask: AskService) -> None:
        """Call the service that the display wants, if it wants one."""
        wanted = self.display.service
        if wanted is None:
            return
        name, type_name = wanted
        self._classes[name] = msg.get_service(type_name).Response

        def take(answer: ServiceAnswer) -> None:
            self._inbox.append((name, answer.problem or answer.cdr))
            self._on_work(self)

        self._calls = ask(name, type_name, take)

    def take_packets(self) -> list[bytes]:
        """Return the packets that the page needs, with only the newest content of each part."""
        with self._lock:
            ready, self._ready = self._ready, {}
            self._told |= self._shown.keys() & ready.keys()
            status, self._status = self._status, None
        packets = list(ready.values())
        if status is not None and status != self._said:
            self._said = status
            packets.append(
                encode_packet(
                    {"type": "status", "id": self.name, "level": status.level, "text": status.text}
                )
            )
        return packets

    def work(self, base: Base) -> None:
        """Turn messages into packets as far as transforms allow."""
        if self._starts:
            self._starts = False
            if self._classes and not self._has_message and not self._inbox:
                self._say(_NO_MESSAGE)
            self._take(self._guarded(self.display.start))
            self._show_answer()
        while self._inbox:
            self._has_message = True
            topic, cdr = self._inbox.popleft()
            self._take(self._outputs(topic, cdr))
            if len(self._waiting) > 2 * _MOST_WAITING:  # not after each message: lookups cost
                self._place_waiting(base)
        self._place_waiting(base)
        if self._base is None or not base.same_place(self._base):
            self._base = base
            self._place_again(base)
        if self._calls is not None and self.display.asks_again:
            self.display.asks_again = False
            self._calls.again()
        if self._ready or self._status is not None:
            self._on_packets()

    def close(self) -> None:
        """End the subscriptions."""
        for end in self.ends:
            end()
        if self._end_asking is not None:
            self._end_asking()
        if self._calls is not None:
            self._calls.close()

    def _take_answer(self, answer: ParameterAnswer) -> None:
        self._answer = answer
        self._starts = True
        self._on_work(self)

    def _show_answer(self) -> None:
        answer = self._answer
        if answer is None:
            return
        if answer.problem:
            self._take([Status.of("error", answer.problem)])
        else:
            self._take(self._guarded(lambda: self.display.take_parameter(answer.text)))

    def _outputs(self, topic: str, cdr: bytes | str) -> list[Output]:
        if isinstance(cdr, str):
            return self._guarded(lambda: self.display.take_problem(cdr))
        if self.display.replays:
            self._last[topic] = cdr
        try:
            message: Any = msg.deserialize(
                self._classes[topic], cdr, arrays=self.display.reads_rows
            )
        except CdrError as error:
            return [Status.of("error", f"A message on {topic} cannot be read: {error}")]
        return self._guarded(lambda: self.display.take(topic, message))

    def _guarded(self, make: Callable[[], list[Output]]) -> list[Output]:
        try:
            return make()
        except Exception:  # an error in one display must not end the thread of all displays
            if not self._logged:  # one traceback, not one for each message of the topic
                self._logged = True
                _logger.exception("The display %s cannot show a message", self.display.kind)
            return [Status.of("error", "This message cannot be shown; the log says why.")]

    def _take(self, outputs: list[Output]) -> None:
        for output in outputs:
            if isinstance(output, Status):
                self._own_status = output
                self._say(output)
            elif isinstance(output, Removal):
                self._forget(output.part)
            elif _is_live(output) and not any(content.event for content in self._waiting):
                self._send_live(output)
            else:
                self._waiting.append(output)

    def _forget(self, part: str) -> None:
        self._shown.pop(part, None)
        self._waiting = deque(content for content in self._waiting if content.part != part)
        packet = encode_packet({"type": "removed", "id": self.name, "part": part})
        with self._lock:  # a page that is far behind gets no updates of removed items
            self._ready.pop(part, None)
            self._ready.pop(f"pose {part}", None)
            if part in self._told:
                self._told.remove(part)
                self._ready[part] = packet

    def _place_waiting(self, base: Base) -> None:
        still: deque[Content] = deque()
        reason = ""
        for content in self._waiting:
            if content.event:  # the message that it updates may be waiting before it
                if still:
                    still.append(content)
                else:
                    self._send_event(content)
                continue
            if _is_live(content):
                self._send_live(content)
                continue
            error = self._place(content, base)
            if error is None:
                self._shown[content.part] = content
                self._say(self._own_status)
            elif not _is_too_old(error, content, base):
                still.append(content)
                reason = f"{error} {error.hint}".strip()
        self._waiting = still
        if len(still) > _MOST_WAITING:
            self._waiting = deque(list(still)[-_MOST_WAITING:])
            text = f"More than {_MOST_WAITING} messages wait, the oldest are dropped: {reason}"
            self._say(Status.of("warn", text))

    def _place(self, content: Content, base: Base) -> TransformException | None:
        """Send a content where it is, or say in the status why that is not known."""
        try:
            pose, arrays = base.pose(content), base.arrays(content)
        except TransformException as error:
            self._say(Status.of("warn", f"{error} {error.hint}".strip()))
            return error
        self._send(content, {"pose": pose}, arrays=arrays)
        return None

    def _place_again(self, base: Base) -> None:
        """Send the poses in another fixed frame."""
        for part, content in list(self._shown.items()):
            if content.frame_id is None or content.locked:
                continue
            if content.placed is not None and self._place(content, base) is None:
                continue
            pose = self._pose(content, base)
            packet = {"type": "pose", "id": self.name, "part": part, "pose": pose}
            with self._lock:  # separate from the content, which may also be waiting to be sent
                self._ready[f"pose {part}"] = encode_packet(packet)

    def _pose(self, content: Content, base: Base) -> list[float] | None:
        """Return the pose; None if it is not known, and the status then says why."""
        try:
            return base.pose(content)
        except TransformException as error:
            self._say(Status.of("warn", f"{error} {error.hint}".strip()))
            return None

    def _send(
        self,
        content: Content,
        place: dict[str, Any],
        key: str | None = None,
        arrays: dict[str, NDArray[Any]] | None = None,
    ) -> None:
        self.on_packages(content.packages)
        header = {
            **content.header,
            "type": "display",
            "id": self.name,
            "kind": self.display.kind,
            "part": content.part,
            **place,
        }
        packet = encode_packet(header, content.arrays if arrays is None else arrays)
        with self._lock:
            self._ready.pop(f"pose {content.part}", None)
            self._ready.pop(content.part if key is None else key, None)  # it comes after events
            self._ready[content.part if key is None else key] = packet

    def _send_live(self, content: Content) -> None:
        """Send the content that is attached to a live frame, or to no frame."""
        self._shown[content.part] = content
        self._send(content, {"frame": content.frame_id, "anchor": list(content.anchor)})

    def _send_event(self, content: Content) -> None:
        number = next(self._events)
        self._send(content, {}, f"event {number}")
        with self._lock:  # a sleeping page must not fill the memory
            self._ready.pop(f"event {number - _MOST_EVENTS}", None)

    def _say(self, status: Status) -> None:
        with self._lock:
            self._status = status


def _nothing(_: object) -> None:
    pass


def _is_live(content: Content) -> bool:
    """Return True if it needs no transform at a stamp."""
    return not content.event and (content.frame_id is None or content.locked)


def _is_too_old(error: TransformException, content: Content, base: Base) -> bool:
    """Return True if no transform that comes can make it visible."""
    if not isinstance(error, ExtrapolationException):
        return False
    assert content.frame_id is not None
    try:
        newest = base.buffer.lookup_transform(base.fixed, content.frame_id).stamp_ns
    except TransformException:
        return False
    return newest is not None and newest > content.last_stamp_ns
