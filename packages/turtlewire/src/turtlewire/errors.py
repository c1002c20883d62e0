"""Every error that turtlewire raises on purpose.

::

    TurtlewireError
    ├── BagError                      a bag is damaged, incomplete or of an unknown kind
    ├── CdrError                      malformed CDR bytes, or a value that its field cannot hold
    ├── InterfaceError                an unknown or unreadable .msg/.srv/.action definition
    ├── InvalidTransformError         a buffer refuses a transform
    ├── UrdfError                     a robot description that urdfdom refuses
    ├── WireError                     the middleware refused something, or is missing
    │   └── UncallableServiceError    a server would misread a request, so none was sent
    └── TransformException            (the tree of ROS 2's tf2; also in tf2_py and tf2_ros)
        ├── ConnectivityException     the two frames are not in one tree
        ├── LookupException           a frame does not exist
        ├── ExtrapolationException    the requested time is outside the data of a transform
        ├── InvalidArgumentException  an empty frame id, or one that starts with '/'
        └── TimeoutException          a remote buffer did not answer in time

``str(error)`` is ROS 2's text, if ROS 2 defines one. Our advice is in ``error.hint``
(an empty string when there is nothing to add); tracebacks show it as a note on Python 3.11 and
later.
"""

from __future__ import annotations

from typing import Any, Literal

from turtlewire.wording import wording

__all__ = [
    "BagError",
    "CdrError",
    "ConnectivityException",
    "ExtrapolationException",
    "InterfaceError",
    "InvalidArgumentException",
    "InvalidTransformError",
    "LookupException",
    "TimeoutException",
    "TransformException",
    "TurtlewireError",
    "UncallableServiceError",
    "UrdfError",
    "WireError",
]


class TurtlewireError(Exception):
    """Base of all errors raised on purpose by this package.

    Attributes:
        hint: One or two plain sentences that say what exists and what to do; empty when there is
            nothing to add.
        is_of_environment: Whether variables, files or the machine caused the error. A program that
            does not catch it ends with one line instead of a traceback.
    """

    hint: str = ""
    is_of_environment: bool = False

    def with_hint(self, hint: str) -> TurtlewireError:
        """Attach ``hint`` and return the same error, for ``raise error.with_hint(...)``."""
        self.hint = hint
        if hint and hasattr(self, "add_note"):
            self.add_note(hint)
        return self

    def in_one_line(self) -> str:
        """Return the text and the hint, as sentences."""
        text, hint = (" ".join(part.split()) for part in (str(self), self.hint))
        if not hint:
            return text
        return f"{text}{'' if text.endswith(('.', '!', '?')) else '.'} {hint}"


class BagError(TurtlewireError, ValueError):
    """A bag is damaged, incomplete, or of a kind that cannot be read or written.

    Attributes:
        others: The errors of other parts of the bag, if reading went on after this one.
    """

    others: tuple[BagError, ...] = ()


class CdrError(TurtlewireError, ValueError):
    """The bytes are not a valid CDR encoding of the type, or a field's value cannot be encoded."""


class InterfaceError(TurtlewireError, LookupError):
    """An interface definition is unknown or cannot be read."""


class InvalidTransformError(TurtlewireError, ValueError):
    """A buffer did not add a transform; the text is tf2's reason.

    Attributes:
        reason: ``"nan"``: a number is not a number; ``"zero quaternion"``: all four numbers of the
            rotation are 0; ``"self"``: a frame in itself; ``"no parent"`` and ``"no child"``: an
            empty name; ``"old"``: older than the cache time by the newest sample; ``"bad name"``:
            a name that no frame can have; ``"too many frames"``: more than ``max_frames``;
            ``"not a rotation"``: a matrix that is not a rigid motion; empty if unknown.
        parent_frame: The parent of the transform.
        child_frame: The child of the transform.
        sender: The sender, as it was given.
        row: The index of the transform in its batch; None outside of batches.
    """

    reason: Literal[
        "nan",
        "zero quaternion",
        "self",
        "no parent",
        "no child",
        "old",
        "bad name",
        "too many frames",
        "not a rotation",
        "",
    ] = ""
    parent_frame: str = ""
    child_frame: str = ""
    sender: str = ""
    row: int | None = None

    @property
    def hint(self) -> str:  # type: ignore[override]  # computed from the reason
        """Advice in one or two sentences: what to do; may be empty."""
        where = "" if self.row is None else f"It is row {self.row} of the batch. "
        return where + _TRANSFORM_HINTS.get(self.reason, "")

    @property
    def __notes__(self) -> list[str]:
        """Lines below the message in a traceback: the hint."""
        return [self.hint] if self.hint else []


_TRANSFORM_HINTS = {
    "nan": "Leave out poses that are not known.",
    "zero quaternion": "A rotation is a quaternion of length 1 in the order x, y, z, w; leave it "
    "out, or pass (0, 0, 0, 1), for no rotation.",
    "self": "Give the frame another parent.",
    "no parent": "Name the parent frame.",
    "no child": "Name the child frame.",
    "old": "By default, a buffer keeps the newest 10 s. To keep everything, create it with "
    "Buffer(cache_time_ns=None).",
    "bad name": "Choose another name.",
    "too many frames": "Make the buffer with a larger max_frames.",
    "not a rotation": "The upper left 3 by 3 numbers must be a rotation matrix, and the last row "
    "0, 0, 0, 1.",
}


class UrdfError(TurtlewireError, ValueError):
    """A robot description that urdfdom refuses, or that has no kinematics.

    ``str(error)`` is the first text that urdfdom logs; ``hint`` names the place.

    Attributes:
        reports: All texts that urdfdom logs, in its order.
        line: The line of the element, from 1; 0 if the description is empty.
        element: The element, for example ``<origin> in <joint name="elbow">``; may be empty.
    """

    def __init__(self, text: str, line: int = 0, element: str = "") -> None:
        super().__init__(text)
        self.reports: list[str] = [text]
        self.line = line
        self.element = element
        self.with_hint(self.place)

    @property
    def place(self) -> str:
        """Line and element, as ``line 7 in <origin> in <joint name="elbow">``; may be empty."""
        if not self.line:
            return ""
        return f"line {self.line} in {self.element}" if self.element else f"line {self.line}"

    def __reduce__(self) -> tuple[object, ...]:
        return (type(self), (str(self), self.line, self.element), {"reports": self.reports})


class WireError(TurtlewireError, RuntimeError):
    """The middleware refused an operation, or cannot be loaded on this platform."""


class UncallableServiceError(WireError):
    """A server of the service would misread a request, so none was sent."""


class TransformException(TurtlewireError):
    """Base of the errors of a transform lookup; catching it catches all of them.

    The hint is computed on first access, because a lookup may fail often, as expected.
    """

    # Only the buffer sets the attributes of its errors.

    def _make_hint(self) -> str:
        return ""

    @property
    def hint(self) -> str:
        """Advice in one or two sentences: what exists and what to do; may be empty."""
        if "_hint" not in self.__dict__:
            self.__dict__["_hint"] = self._make_hint()
        text: str = self.__dict__["_hint"]
        return text

    @hint.setter
    def hint(self, text: str) -> None:
        self.__dict__["_hint"] = text

    @property
    def __notes__(self) -> list[str]:
        """Lines below the message in a traceback: the hint."""
        if "_notes" not in self.__dict__:
            self.__dict__["_notes"] = [self.hint] if self.hint else []
        notes: list[str] = self.__dict__["_notes"]
        return notes

    def with_hint(self, hint: str) -> TransformException:
        """Replace the hint and return the same error."""
        self.hint = hint
        return self

    def __reduce__(self) -> Any:
        # A copy in another process cannot ask the buffer: the hint travels as text.
        kept = {k: v for k, v in self.__dict__.items() if k not in {"_buffer", "_notes"}}
        return (type(self), self.args, {**kept, "_hint": self.hint})


class ConnectivityException(TransformException):
    """No chain of transforms connects the two frames.

    Attributes:
        target_frame: The frame in which the answer was to be expressed. All four are empty if
            unknown.
        source_frame: The frame whose pose was requested.
        target_root: The root of the target's tree.
        source_root: The root of the source's tree.
    """

    target_frame: str = ""
    source_frame: str = ""
    target_root: str = ""
    source_root: str = ""

    def _make_hint(self) -> str:
        if not self.target_frame:
            return ""
        target, source = f"'{self.target_frame}'", f"'{self.source_frame}'"
        if self.target_root == self.source_root:
            return (
                f"{target} and {source} are in one tree now, with the root '{self.target_root}', "
                "but not at the requested time."
            )
        return (
            f"{target} is in the tree with the root '{self.target_root}', "
            f"{source} in the tree with the root '{self.source_root}'. "
            "Publish a transform that connects the two trees."
        )


class LookupException(TransformException):
    """A frame named in the request does not exist.

    Attributes:
        frame: The name; empty if unknown, and if the tree contains a loop.
    """

    frame: str = ""
    _buffer: Any = None

    def _make_hint(self) -> str:
        if self._buffer is None:
            return ""
        if not self.frame:
            return (
                "A frame is below itself. Swap parent and child of the transform that closes the "
                f"loop; {wording(self._buffer).problems} names the frames."
            )
        frame, names = self.frame, self._buffer.frames()
        if not names:
            why_empty = getattr(self._buffer, "_why_empty", None)  # a core alone has none
            return str(why_empty()) if why_empty else "No transform was set yet."
        if frame in (refused := self._buffer._describe_refusals()):
            counts, last = refused[frame]
            text = " ".join(last.split())
            return f"Refused transforms of '{frame}': {sum(counts.values()):,}; the last: {text}"
        if frame in names:
            return f"'{frame}' arrived just after this lookup; a timeout waits for it."
        return _what_exists(frame, names)


def _what_exists(frame: str, names: list[str]) -> str:
    """Return the hint of a lookup of an unknown frame: near names, or some that exist."""
    import difflib
    from string import digits

    # 'turtle1' and 'turtle2' are different turtles; one may not have been spawned yet.
    others = [name for name in names if name.strip(digits) != frame.strip(digits)]
    near = difflib.get_close_matches(frame, others, 3, 0.5)
    if near:
        return f"Did you mean {' or '.join(map(repr, near))}?"
    some = ", ".join(map(repr, names[:10]))
    return f"The frames are {some}{f' and {len(names) - 10} more' if len(names) > 10 else ''}."


#: Nanoseconds of the units that times come in by mistake.
_UNITS = {"s": 10**9, "ms": 10**6, "us": 10**3}
_NEAR_NS = 10 * 10**9
_SINCE_1970_NS = 10**17  # data with clock times, from 1973 on
_LEAST_NS = 10**6  # a stamp so near to the origin is probably in seconds


def _wrong_unit(requested: int, oldest: int, newest: int) -> str:
    """Return what to write if a requested time, or the data, are not in nanoseconds.

    Args:
        requested: A time in which there is no data.
        oldest: The stamp of the oldest sample.
        newest: The stamp of the newest sample.
    """
    if requested == 0:
        return "0 is a time; leave out the time to get the latest." if oldest > 0 else ""
    for unit, factor in _UNITS.items():
        meant = requested * factor
        is_likely = unit == "s" or oldest > _SINCE_1970_NS
        if is_likely and oldest - _NEAR_NS <= meant <= newest + _NEAR_NS:
            return f"Times are in nanoseconds: for {requested} {unit}, write {meant:_}."
    gap = min(abs(requested - oldest), abs(requested - newest))
    if abs(requested) < _LEAST_NS and gap >= 10**9:
        return (
            f"Times are in nanoseconds: for {requested} s, write {requested * 10**9:_}; the data "
            f"begins at {oldest:_}."
        )
    if 0 < newest < _LEAST_NS and 10**9 <= requested <= (newest + 10) * 10**9:
        return f"Stamps are in nanoseconds: is the newest one, {newest}, in seconds?"
    return ""


def _rounded(duration_s: float) -> str:
    return f"{duration_s:.3g}" if duration_s < 999.5 else f"{duration_s:.0f}"


class ExtrapolationException(TransformException):
    """The requested time lies outside the data of at least one transform in the chain.

    As in ROS 2's Python, one class covers the future, the past and missing data; ``reason`` says
    which it is.

    Attributes:
        reason: ``"future"`` if the time is newer than the newest sample; ``"past"`` if it is older
            than the oldest; ``"no data"`` if there is no sample, or only one with another
            stamp; empty if unknown.
        target_frame: The frame in which the answer was to be expressed; empty if unknown.
        source_frame: The frame whose pose was requested. In a lookup through a fixed frame, target
            and source are the ends of the part that failed.
        parent_frame: The parent of the transform that failed.
        child_frame: The child of the transform that failed.
        requested_ns: The requested time, in nanoseconds; None if unknown.
        oldest_ns: The stamp of the oldest sample of the transform; None without data.
        newest_ns: The stamp of the newest sample of the transform; None without data.
    """

    reason: Literal["future", "past", "no data", ""] = ""
    target_frame: str = ""
    source_frame: str = ""
    parent_frame: str = ""
    child_frame: str = ""
    requested_ns: int | None = None
    oldest_ns: int | None = None
    newest_ns: int | None = None
    _buffer: Any = None
    _in_batch: bool = False  # one of many stamps, in a call that has the argument `errors`

    def _make_hint(self) -> str:
        if not self.child_frame:
            return ""
        if self.requested_ns is None or self.oldest_ns is None or self.newest_ns is None:
            return f"No transform of '{self.child_frame}' has arrived since the buffer was cleared."
        advice = _wrong_unit(self.requested_ns, self.oldest_ns, self.newest_ns)
        if not advice and self._in_batch:
            advice = "Pass errors='nan' to get NaN where the data does not reach."
        elif not advice and self.reason == "future":
            latest = wording(self._buffer).latest
            advice = f"Give the lookup a timeout to wait for it, or {latest} to get the latest."
        return f"{self._gap(self.requested_ns, self.oldest_ns, self.newest_ns)} {advice}".rstrip()

    def _gap(self, requested: int, oldest: int, newest: int) -> str:
        link = f"the transform from '{self.child_frame}' to '{self.parent_frame}'"
        late, early = (requested - newest) / 1e9, (oldest - requested) / 1e9
        if self.reason == "future":
            return (
                f"The newest sample of {link} is {_rounded(late)} s older than the requested time."
            )
        if self.reason == "past":
            return (
                f"The oldest sample of {link} is {_rounded(early)} s newer than the requested "
                f"time; the buffer holds {_rounded((newest - oldest) / 1e9)} s."
            )
        side = "older" if late > 0 else "newer"
        return (
            f"The buffer holds one sample of {link}, {_rounded(abs(late))} s {side} than the "
            "requested time; interpolation needs two."
        )


class InvalidArgumentException(TransformException):
    """A frame id is empty or starts with a slash.

    Attributes:
        frame: The name; None if unknown.
    """

    frame: str | None = None

    def _make_hint(self) -> str:
        if self.frame is None:
            return ""
        bare = self.frame.lstrip("/")
        return f"Write '{bare}', without the slash." if bare else "Name a frame."


class TimeoutException(TransformException):
    """A remote buffer did not answer in time; local lookups never raise it."""
