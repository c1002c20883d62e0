"""The results of a display for a message: geometry, removed parts, and problems."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace
from itertools import count
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple, TypeAlias

import numpy as np

from turtlewire.terminal.printable import printable
from turtlewire_view.displays.options import DisplayOptions
from turtlewire_view.package_folders import PackageFolders

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "DEFAULT_BUDGET",
    "Content",
    "Display",
    "Level",
    "Output",
    "Placed",
    "Removal",
    "Status",
    "UnusableMessageError",
    "Vector",
    "frame_of",
    "stamp_ns_of",
]

Level: TypeAlias = Literal["ok", "warn", "error"]
Vector: TypeAlias = tuple[float, float, float]

#: How many points a display may send with one message until the page names its own budget.
DEFAULT_BUDGET = 50_000
_LONGEST_STATUS = 300


class Placed(NamedTuple):
    """Arrays of a content that depend on where its frame is in the fixed frame.

    Attributes:
        arrays: Makes them of the transforms ``fixed_from_frame``, ``(1 + n, 4, 4)``: at the
            content's stamp, and at ``stamps_ns``.
        stamps_ns: Further times that it needs, or None.
    """

    arrays: Callable[[NDArray[np.float64]], dict[str, NDArray[Any]]]
    stamps_ns: NDArray[np.int64] | None = None


@dataclass(frozen=True, slots=True)
class Content:
    """Geometry for the page, in metres and in the frame ``frame_id``.

    Attributes:
        header: What JSON can hold, all numbers finite.
        arrays: Arrays of ``f4``, ``u1``, ``u2``, ``u4``, ``i4`` or ``i1``.
        frame_id: The frame that the geometry is in. None if the content is attached to no frame,
            or its parts name live frames; it is sent as it is.
        stamp_ns: When ``frame_id`` lay where the geometry is; 0 for the newest.
        part: Which part of the display this replaces. A display has as many as it likes, each with
            its own pose.
        anchor: Where the origin of the geometry lies in ``frame_id``: its coordinates are 32-bit
            numbers, which are too coarse far from the origin of a map.
        locked: The content follows the live frame instead of staying where it was at its stamp.
        event: The content changes what came before it and replaces nothing: it is sent once, after
            all that came before it and is not gone, and not kept.
        packages: Names and folders of packages whose meshes and textures the page will ask for.
        placed: Makes the arrays that depend on the fixed frame.
    """

    header: dict[str, Any]
    arrays: dict[str, NDArray[Any]] = field(default_factory=dict)
    frame_id: str | None = None
    stamp_ns: int = 0
    part: str = ""
    anchor: Vector = (0.0, 0.0, 0.0)
    locked: bool = False
    event: bool = False
    packages: tuple[tuple[str, str], ...] = ()
    placed: Placed | None = None

    @property
    def last_stamp_ns(self) -> int:
        """The last time that it needs transforms at."""
        stamps = None if self.placed is None else self.placed.stamps_ns
        return self.stamp_ns if stamps is None else max(self.stamp_ns, int(stamps.max(initial=0)))


@dataclass(frozen=True, slots=True)
class Removal:
    """A removed part: the page drops it, and needs no further poses of it."""

    part: str


@dataclass(frozen=True, slots=True)
class Status:
    """One line about the display; an empty string of level ``ok`` clears the previous line."""

    level: Level
    text: str

    @classmethod
    def of(cls, level: Level, text: str) -> Status:
        """Return a status of one printable line, however long names in it are."""
        line = printable(text)
        return cls(level, line if len(line) <= _LONGEST_STATUS else line[:_LONGEST_STATUS] + "…")


Output: TypeAlias = Content | Removal | Status


class UnusableMessageError(ValueError):
    """A message that a display can draw nothing of; the text is its status."""


class Display:
    """Base of all displays: messages in, geometry out; no wire, no buffer, no threads.

    Attributes:
        kind: Name of the module below ``page/js/displays`` that draws it.
        companions: Further topics of the display: what is appended to the topic's name, and the
            message type there.
        topic: The topic that the user chose; empty for a robot that comes from elsewhere.
        asks_again: Set by the display when :attr:`service` should be called again.
        replays: Whether the last message is shown again with other options.
        reads_rows: Whether it takes sequences of plain messages as arrays, without a Python object
            for each (see :func:`turtlewire.msg.deserialize`).
        options: What the user chose.
        budget: How many points may be sent with one message.
        packages: Where packages with meshes lie.
    """

    kind: ClassVar[str]
    companions: ClassVar[dict[str, str]] = {}
    replays: ClassVar[bool] = False
    reads_rows: ClassVar[bool] = False

    def __init__(
        self,
        options: Mapping[str, object] | None = None,
        *,
        clock: Callable[[], int] = time.monotonic_ns,
    ) -> None:
        self.options = DisplayOptions(options or {}, self.kind)
        self.budget = DEFAULT_BUDGET
        self.packages = PackageFolders()
        self.topic = ""
        self.asks_again = False
        self._clock = clock
        self._numbers = count()
        self._parts: list[str] = []
        self._warnings: list[str] = []

    def set_options(self, options: Mapping[str, object]) -> None:
        """Take the user's choices for the messages to come.

        Raises:
            OptionError: An option is invalid; all options stay unchanged.
        """
        self.options = DisplayOptions(options, self.kind)

    @property
    def parameter(self) -> tuple[str, str] | None:
        """Node and name of a text parameter that the display wants to know, or None."""
        return None

    @property
    def service(self) -> tuple[str, str] | None:
        """Name and type of a service whose responses the display wants, or None.

        Responses go to :meth:`take` with the name of the service.
        """
        return None

    @property
    def sends(self) -> tuple[str, str] | None:
        """Topic and message type that the page publishes for the display, or None."""
        return None

    def marker(self, name: str) -> Content | None:
        """Return the interactive marker of this name; for any thread."""
        del name
        return None

    def take_problem(self, text: str) -> list[Output]:
        """Return the outputs when :attr:`service` cannot be called, for the reason ``text``."""
        raise NotImplementedError

    def take_parameter(self, text: str) -> list[Output]:
        """Return the outputs for a value of :attr:`parameter`; a status comes last."""
        raise NotImplementedError

    @classmethod
    def suits(cls, topic: str, names: Collection[str]) -> bool:
        """Return True if the display is offered for a topic.

        Args:
            topic: Name of the topic.
            names: All topics.
        """
        del topic, names
        return True

    def topics(self, type_name: str) -> dict[str, str]:
        """Return the topics that the display needs, with their message types.

        Args:
            type_name: The message type of :attr:`topic`.
        """
        if not self.topic:
            return {}
        further = {self.topic + suffix: each for suffix, each in self.companions.items()}
        return {self.topic: type_name} | further

    def start(self) -> list[Output]:
        """Return the outputs before the first message and after each change of options."""
        return []

    def take(self, topic: str, message: Any) -> list[Output]:
        """Return the outputs for a message of one of :meth:`topics`."""
        del topic
        return self.content(message)

    def content(self, message: Any) -> list[Output]:
        """Return the outputs for a message, in this order; a status comes last.

        Never raises for what a message holds: what cannot be drawn is said in the status.
        """
        return self._answer(lambda: self._outputs(message))

    def _answer(self, make: Callable[[], list[Output]]) -> list[Output]:
        """Return the outputs of ``make`` and the status.

        NumPy's warnings are off here: displays check for numbers that are not finite, and even the
        conversion of a signalling NaN would print a warning.
        """
        self._warnings = []
        try:
            with np.errstate(over="ignore", invalid="ignore"):
                outputs = make()
        except UnusableMessageError as error:
            return [Status.of("error", str(error))]
        if self._warnings:
            more = f" (and {len(self._warnings) - 1} more)" if len(self._warnings) > 1 else ""
            return [*outputs, Status.of("warn", self._warnings[0] + more)]
        return [*outputs, Status("ok", "")]

    def warn(self, text: str) -> None:
        """Say in the status what of the message is not drawn as sent."""
        self._warnings.append(text)

    def _keep(self, content: Content, most: float) -> list[Output]:
        """Return the content as a new part, and remove the oldest parts beyond ``most``."""
        part = str(next(self._numbers))
        self._parts.append(part)
        outputs: list[Output] = [replace(content, part=part)]
        while len(self._parts) > most:
            outputs.append(Removal(self._parts.pop(0)))
        return outputs

    def _outputs(self, message: Any) -> list[Output]:
        raise NotImplementedError


def frame_of(message: Any) -> str:
    """Return the frame of a message with a header.

    Raises:
        UnusableMessageError: The message has no frame.
    """
    frame_id: str = message.header.frame_id
    if not frame_id:
        raise UnusableMessageError(
            "header.frame_id is empty: the message does not say which frame it is in"
        )
    return frame_id


def stamp_ns_of(message: Any) -> int:
    """Return the stamp of a message with a header, in nanoseconds."""
    stamp = message.header.stamp
    return int(stamp.sec) * 10**9 + int(stamp.nanosec)
