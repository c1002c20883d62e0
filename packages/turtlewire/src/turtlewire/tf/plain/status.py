"""The outcomes of a lookup."""

from enum import IntEnum

__all__ = ["LookupStatus"]


class LookupStatus(IntEnum):
    """The outcome of a lookup; each failure has its exception."""

    OK = 0
    EMPTY_NAME = 1
    """A frame id is empty: InvalidArgumentException."""
    SLASH_NAME = 2
    """A frame id starts with a slash: InvalidArgumentException."""
    UNKNOWN_FRAME = 3
    """A frame does not exist: LookupException."""
    NOT_CONNECTED = 4
    """The frames are not in one tree: ConnectivityException."""
    LOOP = 5
    """The tree has a loop: LookupException."""
    NO_DATA = 6
    """A link has no data, or a single sample of another time: ExtrapolationException."""
    FUTURE = 7
    """The time is newer than the newest data of a link: ExtrapolationException."""
    PAST = 8
    """The time is older than the oldest data of a link: ExtrapolationException."""
    NO_STATIC_DATA = 9
    """A static link was cleared, by the rules of Lyrical: LookupException."""
