"""The source of the view's frames and messages: the network, a bag, a buffer or a robot."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from turtlewire.tf.buffer import Buffer
    from turtlewire_view.robots import RobotJoints

__all__ = [
    "OfflineSource",
    "ParameterAnswer",
    "ServiceAnswer",
    "ServiceCalls",
    "Source",
    "Timeline",
    "TimelineState",
    "Topic",
    "no_service",
]


class Topic(NamedTuple):
    """A topic that a page may show."""

    name: str
    type_name: str
    publishers: int


class ParameterAnswer(NamedTuple):
    """The text of a parameter, or the reason in one line."""

    text: str = ""
    problem: str = ""


class ServiceAnswer(NamedTuple):
    """The response of a service as CDR bytes, or the reason in one line."""

    cdr: bytes = b""
    problem: str = ""


class ServiceCalls(Protocol):
    """The calls of one service. Thread-safe."""

    def again(self) -> None:
        """Call the service again."""
        ...

    def close(self) -> None:
        """Call the service no more."""
        ...


class _NoCalls:
    def again(self) -> None: ...

    def close(self) -> None: ...


def no_service(problem: str, on_answer: Callable[[ServiceAnswer], None]) -> ServiceCalls:
    """Answer once that a service cannot be called.

    Args:
        problem: The reason in one line.
        on_answer: Called with the reason.
    """
    on_answer(ServiceAnswer(problem=problem))
    return _NoCalls()


class OfflineSource:
    """The part of `Source` that those without a network share; ``_WHAT`` says what they show."""

    _WHAT: str

    def departed_frames(self) -> list[str]:
        """Return no frame: the graph is not known."""
        return []

    def ask_parameter(
        self, node: str, name: str, on_answer: Callable[[ParameterAnswer], None]
    ) -> Callable[[], None]:
        """Answer at once that there are no parameters."""
        problem = f"{self._WHAT} has no parameters, so '{name}' of {node} is not known"
        on_answer(ParameterAnswer(problem=f"{problem}; use the topic"))
        return lambda: None

    def ask_service(
        self, name: str, type_name: str, on_answer: Callable[[ServiceAnswer], None]
    ) -> ServiceCalls:
        """Answer at once that there are no services."""
        del type_name
        return no_service(f"{self._WHAT} has no services, so {name} cannot be called", on_answer)

    def advertise(self, topic: str, type_name: str) -> None:
        """Do nothing: no messages are accepted."""

    def drop_old_timeline(self) -> None:
        """Do nothing: the time does not restart."""


class TimelineState(NamedTuple):
    """The state of the time bar; times in seconds, None if unknown.

    Attributes:
        now: The time that is shown.
        oldest: The first time that can be shown.
        newest: The last one.
        live: Whether the newest data is shown as it comes.
        playing: Whether the time advances.
        speed: Seconds of the data in a second.
        simulated: Whether stamps are simulated time.
    """

    now: float
    oldest: float
    newest: float
    live: bool
    playing: bool
    speed: float
    simulated: bool


class Timeline(Protocol):
    """The time that a page shows, and the frames then. Thread-safe."""

    @property
    def buffer(self) -> Buffer:
        """Buffer of the frames."""
        ...

    def stamp_ns(self) -> int | None:
        """Return the time of the frames to show; None for the newest of each."""
        ...

    def state(self) -> TimelineState:
        """Return the state of the time bar."""
        ...

    def pause(self) -> None:
        """Hold the time."""
        ...

    def play(self) -> None:
        """Resume: a bag from its current time, the network from now."""
        ...

    def seek(self, stamp_ns: int) -> None:
        """Show this time, or the nearest that there is."""
        ...

    def set_speed(self, factor: float) -> None:
        """Set the playback speed; live data has only one speed."""
        ...


class Source(Protocol):
    """Frames and messages. Thread-safe.

    Attributes:
        kind: ``live`` or ``bag``.
        name: What the page calls it.
    """

    kind: str
    name: str

    @property
    def joints(self) -> RobotJoints | None:
        """The joints that pages can move, or None."""
        ...

    @property
    def problem(self) -> str:
        """Problem of the source in one line, mostly empty."""
        ...

    @property
    def buffer(self) -> Buffer:
        """The buffer with the frames."""
        ...

    def now_ns(self) -> int:
        """Return the time that ages refer to."""
        ...

    def departed_frames(self) -> list[str]:
        """Return the moving frames whose publisher has left the graph."""
        ...

    def new_timeline(self) -> Timeline:
        """Return the time of one more page; pages of a bag share theirs."""
        ...

    def topics(self) -> list[Topic]:
        """Return the topics, sorted by name."""
        ...

    def subscribe(
        self, topic: str, type_name: str, on_message: Callable[[bytes], None]
    ) -> Callable[[], None]:
        """Call ``on_message(cdr)`` for each message from now on, latched ones at once.

        Returns:
            A function that ends it.
        """
        ...

    def ask_parameter(
        self, node: str, name: str, on_answer: Callable[[ParameterAnswer], None]
    ) -> Callable[[], None]:
        """Call ``on_answer`` with a node's text parameter, now and when the node returns.

        Returns:
            A function that ends it.
        """
        ...

    def ask_service(
        self, name: str, type_name: str, on_answer: Callable[[ServiceAnswer], None]
    ) -> ServiceCalls:
        """Call ``on_answer`` with a service's response, now and when its server returns.

        Args:
            name: Name of the service.
            type_name: Its type, whose request needs no values.
            on_answer: Called on any thread.
        """
        ...

    def advertise(self, topic: str, type_name: str) -> None:
        """Prepare :meth:`publish`, so that subscriptions get the first message as well."""
        ...

    def publish(self, topic: str, type_name: str, cdr: bytes) -> int:
        """Send a message, and give how many subscriptions of the topic are known.

        Raises:
            TurtlewireError: The source cannot send.
        """
        ...

    def drop_old_timeline(self) -> None:
        """Drop frames of a time before the last restart of the simulation."""
        ...

    def on_change(self, call: Callable[[], None]) -> None:
        """Call ``call()`` when frames, topics or the time of all pages change; on any thread."""
        ...

    def close(self) -> None:
        """Leave the wire, close the file."""
        ...
