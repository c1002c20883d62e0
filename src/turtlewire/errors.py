"""Every error that turtlewire raises on purpose.

::

    TurtlewireError
    ├── CdrError                      malformed CDR bytes, or a value that its field cannot hold
    ├── InterfaceError                an unknown or unreadable .msg/.srv/.action definition
    ├── WireError                     the middleware refused something, or is missing
    └── TransformException            (the tree of ROS 2's tf2; also reachable as tf2_py.X and tf2_ros.X)
        ├── ConnectivityException     the two frames are not in one tree
        ├── LookupException           a frame does not exist
        ├── ExtrapolationException    the time asked for is outside of the data
        ├── InvalidArgumentException  an empty frame id, or one that starts with '/'
        └── TimeoutException          a remote buffer did not answer in time

``str(error)`` is the text that ROS 2 defines, where it defines one. What helps beyond it is in ``error.hint``
(an empty string when there is nothing to add); tracebacks show it as a note on Python 3.11 and later.
"""

from __future__ import annotations

__all__ = [
    "CdrError",
    "ConnectivityException",
    "ExtrapolationException",
    "InterfaceError",
    "InvalidArgumentException",
    "LookupException",
    "TimeoutException",
    "TransformException",
    "TurtlewireError",
    "WireError",
]


class TurtlewireError(Exception):
    """Base of all errors raised on purpose by this package.

    Attributes:
        hint: One or two plain sentences that say what exists and what to do; empty when there is nothing to add.
    """

    hint: str = ""

    def with_hint(self, hint: str) -> TurtlewireError:
        """Attach ``hint`` and return the same error, so that ``raise error.with_hint(...)`` reads well."""
        self.hint = hint
        if hint and hasattr(self, "add_note"):
            self.add_note(hint)
        return self


class CdrError(TurtlewireError, ValueError):
    """The bytes are not a valid CDR encoding of the type, or a field's value cannot be encoded."""


class InterfaceError(TurtlewireError, LookupError):
    """An interface definition is unknown or cannot be read."""


class WireError(TurtlewireError, RuntimeError):
    """The middleware refused an operation, or cannot be loaded on this platform."""


class TransformException(TurtlewireError):
    """Base of the errors of a transform lookup; catching it catches all of them."""


class ConnectivityException(TransformException):
    """No chain of transforms connects the two frames."""


class LookupException(TransformException):
    """A frame named in the request does not exist."""


class ExtrapolationException(TransformException):
    """The requested time lies outside of the data of at least one link on the way."""


class InvalidArgumentException(TransformException):
    """A frame id is empty or starts with a slash."""


class TimeoutException(TransformException):
    """A remote buffer did not answer in time; local lookups never raise it."""
