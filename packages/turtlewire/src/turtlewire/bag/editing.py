"""New bags from others: parts of a bag, several bags in one, one bag in pieces."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from itertools import islice
from typing import TYPE_CHECKING, Any, TypedDict

from turtlewire.bag.compression import compress
from turtlewire.bag.copying import ChunkCopy, MessageCopy, can_copy_chunks
from turtlewire.bag.extra_records import extras_of_bags, left_out
from turtlewire.bag.frame_renaming import FrameRenaming
from turtlewire.bag.latched import latched_before
from turtlewire.bag.mcap_storage import McapStorage
from turtlewire.bag.message_choice import check_unit
from turtlewire.bag.metadata import NEWEST_VERSION
from turtlewire.bag.output_channels import OutputChannels, Selection, as_tuple
from turtlewire.bag.pieces import MOST_PIECES, Pieces
from turtlewire.bag.progress import progress_line
from turtlewire.bag.reader import open_bag
from turtlewire.bag.times import date_text, duration_ns, moment_ns, size_bytes
from turtlewire.bag.unfinished import new_folder
from turtlewire.bag.writer_checks import check_name
from turtlewire.errors import BagError
from turtlewire.terminal.suggestion import did_you_mean

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from turtlewire.bag.extra_records import ExtraRecord
    from turtlewire.bag.message import BagMessage
    from turtlewire.bag.reader import Bag
    from turtlewire.tf.datetimes import Span, Stamp

    _Path = str | os.PathLike[str]

__all__ = ["COMPRESSIONS", "BagOptions", "WrittenBags", "copy_bag", "merge_bags", "split_bag"]

#: What the argument ``compression`` may be.
COMPRESSIONS = ("none", "zstd", "lz4", "file")

_FOREVER = 1 << 64
_MESSAGES_FOR_HINT = 1000


class BagOptions(TypedDict, total=False):
    """Options of a new bag: its contents and its storage.

    Attributes:
        start: The log time of the first message. Nanoseconds, a ``datetime64``, or a text: an
            offset from the beginning such as ``"10s"`` or ``"1m20s"``, or a date.
        end: The log time at which the bag ends; messages of that time are left out.
        topics: Names of topics, or patterns such as ``"/camera/*"``; by default all.
        exclude: Names or patterns of topics to leave out.
        types: Names of types, or patterns such as ``"sensor_msgs/*"``; by default all.
        rename_topics: New names of topics by old name.
        rename_frames: New names of frames by old name, for all fields whose name ends with
            ``frame_id``. Messages without such a name stay as they are.
        tf_at_start: Whether the latched messages from before the start are repeated there: the last
            transform of each frame on ``/tf_static``, and as many messages of other latched topics
            as their publishers keep. Their log time is the start.
        storage: ``"mcap"`` or ``"sqlite3"``; by default that of the first bag.
        compression: ``"none"``, ``"zstd"`` or ``"lz4"`` (chunks of MCAP, messages of sqlite3 with
            zstd only), or ``"file"`` (whole files); by default as the first bag.
        progress: Called with the share that is done, from 0 to 1; by default a line on a terminal.
    """

    start: Stamp | str | None
    end: Stamp | str | None
    topics: str | Iterable[str]
    exclude: str | Iterable[str]
    types: str | Iterable[str]
    rename_topics: Mapping[str, str]
    rename_frames: Mapping[str, str]
    tf_at_start: bool
    storage: str | None
    compression: str | None
    progress: Callable[[float], None] | None


@dataclass
class WrittenBags:
    """The result of `copy_bag`, `merge_bags` or `split_bag`.

    Attributes:
        paths: The bags that were written.
        messages: Number of messages in them, without repeated latched ones.
        problems: What could not be read or changed, one sentence each.
    """

    paths: list[str]
    messages: int
    problems: list[str] = field(default_factory=list)


def copy_bag(source: _Path, target: _Path, **options: Unpack[BagOptions]) -> WrittenBags:
    """Write a part of a bag into a new bag: a time, some topics, with other names.

    Args:
        source: The bag.
        target: The folder of the new bag; it must not exist. After an error it does not exist.
        **options: See `BagOptions`.

    Raises:
        BagError: A name in the options fits nothing, or the selection has no messages.
        FileExistsError: ``target`` exists.
        OSError: A file cannot be read or written.
    """
    return _write([source], target, options)


def merge_bags(
    sources: Iterable[_Path], target: _Path, **options: Unpack[BagOptions]
) -> WrittenBags:
    """Write the messages of several bags into a new bag, in order of their log time.

    A topic that follows different definitions in the bags has a channel for each definition.

    Args:
        sources: The bags.
        target: The folder of the new bag; it must not exist. After an error it does not exist.
        **options: See `BagOptions`; offsets count from the beginning of the earliest bag.

    Raises:
        BagError: A topic has different types, and as in `copy_bag`.
        FileExistsError: ``target`` exists.
        OSError: A file cannot be read or written.
    """
    if isinstance(sources, (str, bytes, os.PathLike)):
        raise TypeError("merge_bags() takes a list of bags, and then the new folder")
    return _write(list(sources), target, options)


def split_bag(
    source: _Path,
    target: _Path,
    *,
    every: Span | str | None = None,
    size: int | str | None = None,
    at: Stamp | str | Iterable[Stamp | str] | None = None,
    **options: Unpack[BagOptions],
) -> WrittenBags:
    """Write the messages of a bag into several new bags.

    Exactly one of ``every``, ``size`` and ``at`` is needed. Bags without messages are left out.

    Args:
        source: The bag.
        target: The folder of the new bags ``target/target_0``, ``target/target_1`` and so on; it
            must not exist. After an error it does not exist.
        every: The length of each bag: nanoseconds, or a text such as ``"60s"``.
        size: The size at which a new bag begins, up to some kilobytes of metadata: bytes, or a text
            such as ``"1GB"``. A bag has at least one message.
        at: The times at which a new bag begins, as ``start`` in `BagOptions`.
        **options: See `BagOptions`.

    Raises:
        BagError: The pieces are not positive or too many, and as in `copy_bag`.
        TypeError: Not exactly one of ``every``, ``size`` and ``at`` was given.
        FileExistsError: ``target`` exists.
        OSError: A file cannot be read or written.
    """
    if sum(each is not None for each in (every, size, at)) != 1:
        raise TypeError("split_bag() needs one of every=, size= and at=")
    return _write([source], target, options, _Cuts(every, size, at))


@dataclass(frozen=True)
class _Cuts:
    """The points at which a new bag begins; without any there is one bag."""

    every: Span | str | None = None
    size: int | str | None = None
    at: Stamp | str | Iterable[Stamp | str] | None = None

    @property
    def are_wanted(self) -> bool:
        """True if there may be several bags."""
        return self != _Cuts()

    def max_bytes(self) -> int:
        """Return the largest size of a bag; 0 for no limit."""
        if self.size is None:
            return 0
        limit = size_bytes(self.size)
        if limit <= 0:
            raise BagError(f"size must be positive, got {self.size}")
        return limit

    def starts(self, start_ns: int, end_ns: int, zero_ns: int) -> list[int]:
        """Return the times at which further bags begin.

        Args:
            start_ns: The beginning of the first bag.
            end_ns: The end of the last bag.
            zero_ns: The time from which offsets count.
        """
        if self.at is not None:
            several: Iterable[Stamp | str]
            if isinstance(self.at, Iterable) and not isinstance(self.at, str):
                several = self.at
            else:
                several = [self.at]
            times = sorted({moment_ns(time, zero_ns) for time in several})
            return [time for time in times if start_ns < time < end_ns]
        if self.every is None:
            return []
        step = duration_ns(self.every)
        if step <= 0:
            raise BagError(f"every must be positive, got {self.every}")
        count = (end_ns - start_ns) // step
        if count > MOST_PIECES:
            raise BagError(f"every={self.every} makes {count:,} bags, more than {MOST_PIECES:,}")
        return list(range(start_ns + step, end_ns, step))


def _write(
    sources: Sequence[_Path], target: _Path, options: BagOptions, cuts: _Cuts | None = None
) -> WrittenBags:
    if not sources:
        raise BagError("there are no bags to read")
    unknown = [name for name in options if name not in BagOptions.__annotations__]
    if unknown:
        hint = did_you_mean(unknown[0], BagOptions.__annotations__)
        advice = hint or f"The options are {', '.join(BagOptions.__annotations__)}"
        raise TypeError(f"there is no option '{unknown[0]}'. {advice}")
    with ExitStack() as stack:
        bags = [stack.enter_context(open_bag(source)) for source in sources]
        return _Operation(bags, options, cuts or _Cuts()).run(target)


class _Operation:
    """A call of `copy_bag`, `merge_bags` or `split_bag` on open bags."""

    def __init__(self, bags: list[Bag], options: BagOptions, cuts: _Cuts) -> None:
        self._bags = bags
        self._options = options
        self._cuts = cuts
        self._damage: list[str] = []
        for option in ("rename_topics", "rename_frames"):
            if not isinstance(names := options.get(option) or {}, Mapping):
                kind = type(names).__name__
                raise TypeError(f"{option} must be a dict of new names by old name, not {kind}")
        renames = options.get("rename_topics", {})
        self._selection = Selection(
            as_tuple(options.get("topics", ())),
            as_tuple(options.get("exclude", ())),
            as_tuple(options.get("types", ())),
            renames,
        )
        self._selection.check(bags)
        frames = options.get("rename_frames")
        self._frames = FrameRenaming(frames) if frames else None
        self._storage = options.get("storage") or _storage_of(bags[0])
        self._max_bytes = cuts.max_bytes()
        self._windows = self._find_windows()
        self._channels = OutputChannels(bags, self._selection, self._storage)
        self._extras = extras_of_bags(bags, self._damaged)
        if self._storage != "mcap":
            if options.get("compression") == "lz4":
                raise BagError("sqlite3 files compress messages with zstd, not with lz4")
            self._damage += left_out(self._extras, "only MCAP files have such records")
            self._extras = []

    def run(self, target: _Path) -> WrittenBags:
        check_name(os.path.basename(os.path.abspath(target)))
        tell = self._options.get("progress") or progress_line(
            f"writing {os.path.basename(os.path.abspath(target))}"
        )
        with new_folder(target) as folder:
            pieces = Pieces(
                folder,
                self._channels,
                self._writer_options(),
                numbered=self._cuts.are_wanted,
                max_bytes=self._max_bytes,
                latched=self._latched if self._options.get("tf_at_start") else None,
                metadata=[each for each in self._extras if each.log_time_ns is None],
            )
            try:
                self._copy(pieces, tell)
                self._check(pieces)
            except BaseException:
                pieces.abandon()
                raise
            finally:
                tell(1.0)
        parent = os.path.dirname(os.path.abspath(target))
        paths = [os.path.join(parent, path) for path in pieces.paths]
        return WrittenBags(paths, pieces.messages, self._problems())

    def _copy(self, pieces: Pieces, tell: Callable[[float], None]) -> None:
        takes = self._selection.takes
        copy: MessageCopy | ChunkCopy
        compression = self._chunk_compression()
        if self._storage == "mcap" and self._frames is None and can_copy_chunks(self._bags):
            copy = ChunkCopy(self._bags, takes, self._channels, compression, self._damaged)
        else:
            copy = MessageCopy(self._bags, takes, self._channels, self._frames, self._damaged)
        count = len(self._windows)
        for number, (start_ns, end_ns) in enumerate(self._windows):
            pieces.begin(start_ns or None)

            def tell_all(share: float, number: int = number) -> None:
                tell(min(0.999, (number + share) / count))

            pieces.attachments += self._attachments(start_ns, end_ns)
            copy.copy(pieces, start_ns, end_ns, tell_all)
        pieces.close()
        reason = "no bag with messages follows it"
        self._damage += left_out(pieces.attachments, reason)

    def _attachments(self, start_ns: int, end_ns: int) -> list[ExtraRecord]:
        """Return the attachments with ``start_ns <= log time < end_ns``."""
        return [
            each
            for each in self._extras
            if each.log_time_ns is not None and start_ns <= each.log_time_ns < end_ns
        ]

    def _check(self, pieces: Pieces) -> None:
        """Refuse an empty result, and frames to rename that no message has."""
        if self._frames is not None and (unused := self._frames.unused()):
            hint = did_you_mean(unused[0], self._some_frames(self._frames))
            unread = " ".join(self._frames.problems.values())
            raise BagError(f"no message has the frame '{unused[0]}' to rename").with_hint(
                f"{hint} {unread}".strip()
            )
        if not pieces.messages:
            damage = self._problems()
            raise BagError(f"the selection has no messages: {self._covered()}").with_hint(
                f"Damaged: {damage[0]}" if damage else ""
            )

    def _covered(self) -> str:
        """Return from when to when the bags have messages."""
        what = " and ".join(bag.path for bag in self._bags)
        filled = [bag for bag in self._bags if len(bag)]
        if not filled:
            return f"{what} is empty"
        start = date_text(min(bag.start_ns for bag in filled))
        end = date_text(max(bag.end_ns for bag in filled))
        return f"{what} has messages from {start} to {end}"

    def _some_frames(self, frames: FrameRenaming) -> set[str]:
        """Return the frames that the first messages name."""
        found: set[str] = set()
        for bag in self._bags:
            with contextlib.suppress(BagError):
                for message in islice(bag.messages(), _MESSAGES_FOR_HINT):
                    found |= frames.frames_in(message)
        return found

    def _find_windows(self) -> list[tuple[int, int]]:
        """Return the first log time of each piece, and the one that follows its last."""
        filled = [bag for bag in self._bags if len(bag)] or self._bags
        first = min(bag.start_ns for bag in filled)
        last = max(bag.end_ns for bag in filled)
        given_start, given_end = self._options.get("start"), self._options.get("end")
        start = 0 if given_start is None else moment_ns(given_start, first, "start")
        end = _FOREVER if given_end is None else moment_ns(given_end, first, "end")
        check_unit(filled[0].metadata, start=start, end=end)
        if end <= start:
            raise BagError(f"the end, {given_end}, is not after the start, {given_start or first}")
        begins = self._cuts.starts(max(start, first), min(end, last + 1), first)
        return list(zip([start, *begins], [*begins, end], strict=True))

    def _latched(self, time_ns: int) -> list[BagMessage]:
        found = latched_before(self._bags, self._selection.takes, time_ns, self._damaged)
        if self._frames is None:
            return found
        return [message._replace(data=self._frames.apply(message)) for message in found]

    def _damaged(self, error: BagError) -> None:
        self._damage.append(str(error))

    def _problems(self) -> list[str]:
        found = [problem for bag in self._bags for problem in bag.problems]
        unchanged = self._frames.problems.values() if self._frames else ()
        return list(dict.fromkeys([*found, *self._damage, *unchanged]))

    def _chunk_compression(self) -> str | None:
        """Return the compression that all chunks must have; None if each may keep its own."""
        wanted = self._options.get("compression")
        if wanted is None:
            return None
        return wanted if wanted in ("zstd", "lz4") else ""

    def _writer_options(self) -> dict[str, Any]:
        """Return the arguments of `BagWriter`."""
        first = self._bags[0].metadata
        custom: dict[str, str] = {}
        for bag in reversed(self._bags):
            custom |= bag.metadata.custom_data
        options = {
            "storage": self._storage,
            "custom_data": custom,
            "ros_distro": first.ros_distro,
            "metadata_version": min(NEWEST_VERSION, max(1, first.version)),
        }
        return options | _compression_options(
            self._options.get("compression") or _compression_of(self._bags[0]), self._storage
        )


def _storage_of(bag: Bag) -> str:
    return "sqlite3" if bag.metadata.storage == "sqlite3" else "mcap"


def _compression_of(bag: Bag) -> str:
    """Return the compression of a bag as the argument ``compression``."""
    if bag.metadata.compression_mode:
        return "file" if bag.metadata.compression_mode == "FILE" else "zstd"
    for file in bag.readable_files(bag.metadata.paths[:1], []):
        if isinstance(file, McapStorage):
            return file.file.compression or "none"
    return "none"


def _compression_options(compression: str, storage: str) -> dict[str, str]:
    """Return the arguments of `BagWriter` for a compression."""
    if compression not in COMPRESSIONS:
        hint = did_you_mean(compression, COMPRESSIONS) or f"Use {', '.join(COMPRESSIONS)}."
        raise BagError(f"unknown compression '{compression}'").with_hint(hint)
    if compression == "file":
        return {"compression_mode": "FILE"}
    if compression == "none":
        return {}
    if storage == "mcap":
        compress(compression, b"")  # a missing package raises before anything is written
        return {"compression": compression}
    return {"compression_mode": "MESSAGE"}
