"""Makes buffers with the transforms of bags."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.bag.transforms import fill_buffer
from turtlewire.tf.buffer import Buffer

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable

    from turtlewire.bag.transform_report import TransformReport

__all__ = ["load_transforms"]

_FOREVER = (1 << 64) - 1


def load_transforms(
    path: str | os.PathLike[str],
    *,
    topics: str | Iterable[str] = "/tf",
    static_topics: str | Iterable[str] = "/tf_static",
    start_ns: int = 0,
    end_ns: int = _FOREVER,
    cache_time_ns: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> tuple[Buffer, TransformReport]:
    """Read the transforms of a bag into a new buffer.

    Args:
        path: The bag; see `turtlewire.bag.open_bag`.
        topics: Where transforms were published, ``"/tf"`` or other names.
        static_topics: Where static transforms were published. They are taken whatever the window.
        start_ns: Log time of the first message to take, in nanoseconds or as ``datetime64``.
        end_ns: Log time of the last message to take.
        cache_time_ns: How much history the buffer keeps; None keeps all.
        progress: Called with the share that was read, from 0 to 1; by default a line is drawn on a
            terminal when reading takes more than a second.

    Returns:
        The buffer, and what was found.

    Raises:
        FileNotFoundError: ``path`` does not exist.
        BagError: ``path`` is not a bag, has none of the topics, or a topic other than the default
            is missing or has another type.
        ValueError: The window ends before it begins.
    """
    buffer = Buffer(cache_time_ns)
    report = fill_buffer(
        buffer,
        path,
        topics=topics,
        static_topics=static_topics,
        start_ns=start_ns,
        end_ns=end_ns,
        progress=progress,
    )
    return buffer, report
