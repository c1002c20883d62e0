"""What is going on in a buffer: who sends which link how often, what was refused and why, and who contradicts whom.

Also saves a buffer to a file and loads it again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from os import PathLike

    from turtlewire.tf.buffer import Buffer

__all__ = [
    "Conflict",
    "LinkInfo",
    "Malformed",
    "Refused",
    "Sender",
    "conflicts",
    "links",
    "load",
    "malformed",
    "refusals",
    "save",
]

_FORMAT = "turtlewire buffer 1"


class Sender(NamedTuple):
    """Who has sent samples of a link, with which parent."""

    name: str
    parent_frame: str
    samples: int
    newest_ns: int


class LinkInfo(NamedTuple):
    """One link of the tree: how a child frame lies in its parent."""

    child_frame: str
    parent_frame: str
    static: bool
    samples: int
    oldest_ns: int
    newest_ns: int
    parent_changes: int
    """How often the parent changes in the samples kept."""
    memory_bytes: int
    """Of the samples, with the room kept for more; 0 on the plain core."""
    senders: tuple[Sender, ...]
    """The last one to send is the last one here."""

    @property
    def rate_hz(self) -> float:
        """Mean rate of the samples kept; 0 for a static link or a single sample."""
        span = self.newest_ns - self.oldest_ns
        return (self.samples - 1) * 1e9 / span if span else 0.0

    def age_ns(self, now_ns: int) -> int:
        """How old the newest sample is; 0 for a static link."""
        return 0 if self.static else now_ns - self.newest_ns


class Refused(NamedTuple):
    """What was refused of one child frame."""

    counts: dict[str, int]
    """By reason: self_transform, no_child_frame, no_parent_frame, nan_value, old_data, reserved_name, bad_name."""
    last: str
    """The reason of the last one in tf2's words."""


class Malformed(NamedTuple):
    """Messages of which nothing could be taken, because the bytes are no ``TFMessage``."""

    messages: int
    last: str
    """What was wrong with the last one; empty if there was none."""
    sender: str
    """Who sent that one."""


class Conflict(NamedTuple):
    """Senders of one frame who contradict each other."""

    kind: str
    """``two publishers`` or ``two parents``."""
    child_frame: str
    text: str


def links(buffer: Buffer) -> list[LinkInfo]:
    """All links, in the order in which their frames were first heard of."""
    return [LinkInfo(*row[:8], _senders(row[8])) for row in buffer._describe_links()]


def _senders(rows: list[tuple[str, str, int, int]]) -> tuple[Sender, ...]:
    """One for each name and parent: a sender that got its name late has several rows."""
    merged: dict[tuple[str, str], Sender] = {}
    for name, parent, samples, newest in rows:
        known = merged.pop((name, parent), Sender(name, parent, 0, newest))
        merged[name, parent] = Sender(
            name, parent, known.samples + samples, max(known.newest_ns, newest)
        )
    return tuple(merged.values())


def refusals(buffer: Buffer) -> dict[str, Refused]:
    """What was refused, by child frame; beyond 1000 frames, the rest under ``(others)``."""
    return {
        child: Refused(counts, last)
        for child, (counts, last) in buffer._describe_refusals().items()
    }


def malformed(buffer: Buffer) -> Malformed:
    """How many messages could not be decoded, and what was wrong with the last one."""
    return Malformed(*buffer._describe_malformed())


def conflicts(buffer: Buffer) -> list[Conflict]:
    """Frames that more than one sender moves, or that go back and forth between parents.

    A sender counts as long as it has sent something within the history that the buffer keeps of the
    link. A frame that is handed over once from one parent to another, as when a gripper takes a
    part, is no conflict.
    """
    found = []
    for link in links(buffer):
        active = [
            sender for sender in link.senders if link.static or sender.newest_ns >= link.oldest_ns
        ]
        names = sorted({sender.name for sender in active})
        parents = sorted({sender.parent_frame for sender in active})
        if len(names) > 1:
            text = f"'{link.child_frame}' is sent by {' and '.join(map(repr, names))}; each frame should have one publisher."
            found.append(Conflict("two publishers", link.child_frame, text))
        if len(parents) > 1 and (link.static or link.parent_changes > 1):
            both = " and ".join(map(repr, parents))
            text = f"'{link.child_frame}' goes back and forth between the parents {both}; a frame has one parent."
            found.append(Conflict("two parents", link.child_frame, text))
    return found


def save(buffer: Buffer, path: str | PathLike[str]) -> None:
    """Write all samples and static transforms to a file (NumPy's ``.npz``, without pickled objects)."""
    import json

    import numpy as np

    from turtlewire.errors import LookupException

    arrays: dict[str, Any] = {}
    runs: list[tuple[str, str, bool, str]] = []
    for link in links(buffer):
        sender = link.senders[-1].name if link.senders else ""
        try:
            history = buffer.samples(link.child_frame)
        except LookupException:  # removed since the links were listed
            continue
        for parent, stamps, poses in history:
            arrays[f"stamps{len(runs)}"], arrays[f"poses{len(runs)}"] = stamps, poses
            runs.append((parent, link.child_frame, link.static, sender))
    header = json.dumps({"format": _FORMAT, "cache_time_ns": buffer.cache_time_ns, "runs": runs})
    with open(path, "wb") as file:
        np.savez_compressed(file, header=np.frombuffer(header.encode(), dtype=np.uint8), **arrays)


def load(path: str | PathLike[str]) -> Buffer:
    """A new buffer with what ``save`` wrote.

    Raises:
        ValueError: The file is something else, or damaged.
    """
    import json
    import zipfile
    import zlib

    import numpy as np

    try:
        with open(path, "rb") as stream, np.load(stream, allow_pickle=False) as file:
            return _fill(json.loads(bytes(file["header"])), file)
    except (
        KeyError,
        TypeError,
        ValueError,
        IndexError,
        EOFError,
        zipfile.BadZipFile,
        zlib.error,
    ) as error:
        raise ValueError(f"{path} is no saved buffer: {error}") from error


def _fill(header: Any, file: Any) -> Buffer:
    from turtlewire.tf.buffer import Buffer

    if header["format"] != _FORMAT:
        raise ValueError(f"its format is {header['format']!r}, not {_FORMAT!r}")
    buffer = Buffer(header["cache_time_ns"])
    for i, (parent, child, static, sender) in enumerate(header["runs"]):
        stamps, poses = file[f"stamps{i}"], file[f"poses{i}"]
        if static:
            x, y, z, qx, qy, qz, qw = poses[0].tolist()
            buffer.set_transform(parent, child, 0, (x, y, z), (qx, qy, qz, qw), True, sender)
        else:
            buffer.set_transforms(parent, child, stamps, poses, sender)
    return buffer
