"""The files of a bag that is being written, one after another."""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from turtlewire.bag.compression import write_zstd_file
from turtlewire.bag.files import file_name
from turtlewire.bag.mcap_writer import McapWriter
from turtlewire.bag.metadata import BagMetadata, FileInfo, TopicInfo, write_metadata
from turtlewire.bag.sqlite_writer import SqliteWriter, merge_by_copy
from turtlewire.bag.writer_checks import ENDINGS
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from turtlewire.bag.message import BagChannel

__all__ = ["FileSeries"]

_FileWriter = McapWriter | SqliteWriter


class FileSeries:
    """Opens the files of a bag, defines its channels in each, and sums up what they hold.

    Args:
        folder: The bag, which exists.
        metadata: Gets what the finished files hold.
        chunks: Arguments of `McapWriter`.
        max_files: The oldest file is removed when there would be more; 0 keeps all.

    Attributes:
        current: The file that is being written; None when the bag is closed.
        channels: The channels of each file, by the key that `add_channel` gets.
        ids: The number of each channel in the current file, by the same key.
    """

    def __init__(
        self, folder: str, metadata: BagMetadata, chunks: dict[str, Any], max_files: int
    ) -> None:
        self._folder = folder
        self._metadata = metadata
        self._chunks = chunks
        self._max_files = max_files
        self._opened_files = 0
        self._counts_of_files: list[dict[str, int]] = []
        self.channels: dict[str, BagChannel] = {}
        self.ids: dict[str, int] = {}
        self.current: _FileWriter | None = self._new_file()

    def open_file(self) -> _FileWriter:
        """Return the current file.

        Raises:
            BagError: The bag is closed.
        """
        if self.current is None:
            raise BagError(f"{self._folder} is closed")
        return self.current

    def topics(self) -> list[TopicInfo]:
        """Return the topics; the channels of one topic count together."""
        topics: dict[str, TopicInfo] = {}
        for topic in (channel.topic for channel in self.channels.values()):
            known = topics.get(topic.name)
            topics[topic.name] = (
                replace(known, message_count=known.message_count + topic.message_count)
                if known
                else topic
            )
        return list(topics.values())

    def add_channel(self, key: str, channel: BagChannel) -> None:
        """Define a channel in the current file and in all that follow."""
        file = self.open_file()
        self.channels[key] = replace(channel, topic=replace(channel.topic, message_count=0))
        self.ids[key] = file.define(channel, self._metadata.version)

    def remove_channel(self, key: str) -> None:
        """Take a channel without messages out of the metadata and of the files that follow."""
        del self.channels[key], self.ids[key]

    def split(self, on_compress: Callable[[str], None] | None) -> tuple[str, str]:
        """Finish the current file and begin another; see `BagWriter.split`."""
        file, self.current = self.open_file(), None
        try:
            finished = self._finish(file, on_compress)
            self._remove_old_files()
            self.current = self._new_file()
        finally:
            if self.current is None:  # nothing can be written any more
                write_metadata(self._folder, self._whole_metadata())
        for key, channel in self.channels.items():
            self.ids[key] = self.current.define(channel, self._metadata.version)
        return finished, self.current.path

    def close(self, on_compress: Callable[[str], None] | None) -> None:
        """Finish the current file and write ``metadata.yaml``; closing twice does nothing."""
        if self.current is not None:
            file, self.current = self.current, None
            try:
                self._finish(file, on_compress)
            finally:
                write_metadata(self._folder, self._whole_metadata())

    def abandon(self) -> None:
        """Close the current file as it is, before the folder is removed."""
        if self.current is not None:
            file, self.current = self.current, None
            file.abandon()

    def _new_file(self) -> _FileWriter:
        storage, distro = self._metadata.storage, self._metadata.ros_distro
        name = file_name(self._folder, self._opened_files, distro)
        self._opened_files += 1
        path = os.path.join(self._folder, f"{name}.{ENDINGS[storage]}")
        file = McapWriter(path, **self._chunks) if storage == "mcap" else SqliteWriter(path, distro)
        try:
            file.embed(self._whole_metadata())
        except BaseException:
            file.abandon()
            raise
        return file

    def _finish(self, file: _FileWriter, on_compress: Callable[[str], None] | None) -> str:
        """Close a file and take it into the metadata; returns its path.

        What waits and cannot be written is lost, the rest is finished before the error is raised.
        """
        try:
            try:
                file.flush()
            finally:
                self._enter(file)
                file.embed(self._whole_metadata())
        finally:
            file.close()
        if self._metadata.compression_mode == "FILE":
            if on_compress is not None:
                on_compress(file.path)
            merge_by_copy(file.path)
            write_zstd_file(file.path, file.path + ".zstd")
            os.remove(file.path)
            self._metadata.paths[-1] += ".zstd"
        return os.path.join(self._folder, self._metadata.paths[-1])

    def _enter(self, file: _FileWriter) -> None:
        """Take what a file holds into the metadata."""
        file.discard()
        counts_of_file = {key: file.channel_counts.get(self.ids[key], 0) for key in self.channels}
        for key, channel in self.channels.items():
            channel.topic.message_count += counts_of_file[key]
        self._counts_of_files.append(counts_of_file)
        name = os.path.basename(file.path)
        start = file.start_ns if file.message_count else 0
        duration = file.end_ns - start
        self._metadata.files.append(FileInfo(name, start, duration, file.message_count))
        self._metadata.paths.append(name)

    def _remove_old_files(self) -> None:
        """Remove the oldest files, so that one more is not too many."""
        while self._max_files and len(self._metadata.paths) >= self._max_files:
            with suppress(FileNotFoundError):  # the user has moved it away
                os.remove(os.path.join(self._folder, self._metadata.paths.pop(0)))
            self._metadata.files.pop(0)
            for key, count in self._counts_of_files.pop(0).items():
                if key in self.channels:
                    self.channels[key].topic.message_count -= count

    def _whole_metadata(self) -> BagMetadata:
        """Return the metadata with the totals of the files that are finished."""
        filled = [file for file in self._metadata.files if file.message_count]
        start = min((file.start_ns for file in filled), default=0)
        end = max((file.start_ns + file.duration_ns for file in filled), default=0)
        self._metadata.start_ns, self._metadata.duration_ns = start, end - start
        self._metadata.message_count = sum(file.message_count for file in filled)
        self._metadata.topics = self.topics()
        return self._metadata
