"""Every error that turtlewire raises on purpose.

::

    TurtlewireError
    ├── BagError                      a bag is damaged, incomplete or of an unknown kind
    ├── CdrError                      malformed CDR bytes, or a value that its field cannot hold
    ├── InterfaceError                an unknown or unreadable .msg/.srv/.action definition
    ├── WireError                     the middleware refused something, or is missing
    │   └── UncallableServiceError    a server would misread a request, so none was sent
    └── TransformException            (the tree of ROS 2's tf2; also in tf2_py and tf2_ros)
        ├── ConnectivityException     the two frames are not in one tree
        ├── LookupException           a frame does not exist
        ├── ExtrapolationException    the requested time is outside the data of a transform
        ├── InvalidArgumentException  an empty frame id, or one that starts with '/'
        └── TimeoutException          a remote buffer did not answer in time

``str(error)`` is the text that ROS 2 defines, if it defines one. Our advice is in ``error.hint``
(an empty string when there is nothing to add); tracebacks show it as a note on Python 3.11 and
later.
"""

from __future__ import annotations

from typing import Any, Literal

__all__ = [
    "BagError",
    "CdrError",
    "ConnectivityException",
    "ExtrapolationException",
    "InterfaceError",
    "InvalidArgumentException",
    "LookupException",
    "TimeoutException",
    "TransformException",
    "TurtlewireError",
    "UncallableServiceError",
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
    """A bag is damaged, incomplete, or of a kind that cannot be read or written."""


class CdrError(TurtlewireError, ValueError):
    """The bytes are not a valid CDR encoding of the type, or a field's value cannot be encoded."""


class InterfaceError(TurtlewireError, LookupError):
    """An interface definition is unknown or cannot be read."""


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
        frame: The name; empty if unknown.
    """

    frame: str = ""
    _buffer: Any = None

    def _make_hint(self) -> str:
        import difflib
        from string import digits

        if self._buffer is None:
            return ""
        frame, names = self.frame, self._buffer.frame_strings()
        if not names:
            return (
                "No transform has arrived yet. Is a broadcaster running, and does a "
                "TransformListener fill this buffer?"
            )
        # 'turtle1' and 'turtle2' are two things, of which one may not have been spawned yet.
        others = [name for name in names if name.strip(digits) != frame.strip(digits)]
        near = difflib.get_close_matches(frame, others, 3, 0.5)
        if near:
            return f"Did you mean {' or '.join(map(repr, near))}?"
        some = ", ".join(map(repr, names[:10]))
        return f"The frames are {some}{f' and {len(names) - 10} more' if len(names) > 10 else ''}."


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
        requested_ns: The requested time, in nanoseconds.
        oldest_ns: The stamp of the oldest sample of the transform; 0 without data.
        newest_ns: The stamp of the newest sample of the transform; 0 without data.
    """

    reason: Literal["future", "past", "no data", ""] = ""
    target_frame: str = ""
    source_frame: str = ""
    parent_frame: str = ""
    child_frame: str = ""
    requested_ns: int = 0
    oldest_ns: int = 0
    newest_ns: int = 0
    _has_data: bool = True

    def _make_hint(self) -> str:
        if not self.child_frame:
            return ""
        link = f"the transform from '{self.child_frame}' to '{self.parent_frame}'"
        if self.reason == "future":
            gap = (self.requested_ns - self.newest_ns) / 1e9
            return (
                f"The newest sample of {link} is {gap:.6g} s older than the requested time. "
                "Give the lookup a timeout to wait for it, or request time 0, the latest."
            )
        if self.reason == "past":
            gap = (self.oldest_ns - self.requested_ns) / 1e9
            kept = (self.newest_ns - self.oldest_ns) / 1e9
            return (
                f"The oldest sample of {link} is {gap:.6g} s newer than the requested time; "
                f"the buffer holds {kept:.6g} s."
            )
        return self._no_data_hint(link)

    def _no_data_hint(self, link: str) -> str:
        if not self._has_data:
            return f"No transform of '{self.child_frame}' has arrived since the buffer was cleared."
        gap = (self.requested_ns - self.newest_ns) / 1e9
        side = "older" if gap > 0 else "newer"
        return (
            f"The buffer holds one sample of {link}, {abs(gap):.6g} s {side} than the requested "
            "time; interpolation needs two."
        )


class InvalidArgumentException(TransformException):
    """A frame id is empty or starts with a slash."""


class TimeoutException(TransformException):
    """A remote buffer did not answer in time; local lookups never raise it."""
