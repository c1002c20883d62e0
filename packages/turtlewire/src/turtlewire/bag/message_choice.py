"""Arguments that choose messages of a bag: topics, types and times."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import TYPE_CHECKING, Any

from turtlewire.bag.metadata import full_type_name
from turtlewire.tf.datetimes import as_nanoseconds

if TYPE_CHECKING:
    from turtlewire.bag.metadata import BagMetadata
    from turtlewire.tf.datetimes import Stamp

__all__ = ["check_unit", "full_type_names", "nearest_names", "one_or_several", "window"]

_FOREVER = (1 << 64) - 1
_SINCE_1970_NS = 10**17  # times of a clock, from 1973 on


def window(start_ns: Stamp | None, end_ns: Stamp | None) -> tuple[int, int]:
    """Return the two times of a window in nanoseconds; None leaves an end open.

    Raises:
        ValueError: ``end_ns`` is before ``start_ns``.
    """
    start = 0 if start_ns is None else as_nanoseconds(start_ns, "start_ns")
    end = _FOREVER if end_ns is None else as_nanoseconds(end_ns, "end_ns")
    if end < start:
        raise ValueError(f"the window ends before it begins: start_ns={start}, end_ns={end}")
    return start, end


def check_unit(metadata: BagMetadata, **times: int) -> None:
    """Refuse times in seconds, or from the beginning, for a bag with times since 1970.

    Args:
        metadata: The bag's.
        **times: The ends of a window by the names of their arguments; 0 leaves one open.

    Raises:
        ValueError: A time is before 1973, and the bag is not.
    """
    if not metadata.message_count or metadata.start_ns < _SINCE_1970_NS:
        return
    end_ns = metadata.start_ns + metadata.duration_ns
    for name, time in times.items():
        if 0 < time < _SINCE_1970_NS:
            raise ValueError(
                f"{name} is {time}, but the bag covers {metadata.start_ns} to {end_ns}: "
                "pass nanoseconds since 1970; from the beginning, bag.start_ns + nanoseconds"
            )


def one_or_several(names: str | Iterable[str] | None, argument: str) -> set[str] | None:
    """Return one name or several as a set; None means all.

    Raises:
        TypeError: A name is not a str; the text names the ``argument``.
    """
    if names is None:
        return None
    is_one = isinstance(names, str) or not hasattr(names, "__iter__")
    several: list[Any] = [names] if is_one else list(names)
    strange = [name for name in several if not isinstance(name, str)]
    if isinstance(names, (bytes, tuple)) and strange:
        strange = [names]  # bytes, and named tuples such as messages
    if strange:
        kind = strange[0]
        shown = f"the class {kind.__name__}" if isinstance(kind, type) else type(kind).__name__
        raise TypeError(f"{argument} must be a str or several, not {shown}")
    return set(several)


def full_type_names(types: str | Iterable[str] | None) -> set[str] | None:
    """Return types as a set of names with three parts; None means all.

    Raises:
        TypeError: A name is not a str.
    """
    found = one_or_several(types, "types")
    return None if found is None else {full_type_name(name) for name in found}


def nearest_names(name: str, known: Collection[str], what: str = "topics") -> str:
    """Return the hint for a name that a bag does not have: near names, else all."""
    import difflib

    near = difflib.get_close_matches(name, list(known), 3, 0.5)
    if near:
        return f"Did you mean {' or '.join(near)}?"
    return f"Its {what} are {', '.join(sorted(known))}." if known else f"It has no {what}."
