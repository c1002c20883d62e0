"""Bags: reads and writes ROS 2's recordings without ROS.

::

    from turtlewire.bag import open_bag

    with open_bag("my_bag") as bag:
        print(bag)
        for message in bag.messages("/odom"):
            print(message.log_time_ns, message.decode())

==================  ========================================================================
module              contents
==================  ========================================================================
`reader`            `Bag`, `open_bag`: messages in order of time over all files
`message_choice`    arguments that choose messages: topics, types and times
`transforms`        the TF of a bag read into a buffer, for `Buffer.from_bag`
`transform_report`  `TransformReport`: the links of a bag, and their problems
`trajectories`      odometry and poses of a topic, for `Trajectory.from_bag`
`progress`          a line that shows the progress of an operation
`columns`           `Columns`: fields of all messages of a topic as NumPy arrays
`column_fields`     fields that can be columns, their offsets, and lists of texts
`sensor_arrays`     images and point clouds as arrays
`overview`          `describe_bag`: the contents of a bag, topic by topic
`notebook`          the display of bags in Jupyter
`editing`           `copy_bag`, `merge_bags`, `split_bag`: new bags from others
`times`             times, lengths of time and sizes as text
`copying`           the messages of bags, or their chunks as bytes, in new bags
`extra_records`     attachments and metadata records of MCAP files
`output_channels`   the topics and channels of a new bag
`pieces`            the new bags, one after another
`unfinished`        folders that appear when they are complete
`latched`           latched messages before a given time
`frame_renaming`    finds the fields that name frames, and renames the frames
`message`           `BagMessage` and its channel, a topic with one definition of its type
`written_types`     types as a bag defines them, ROS 1 too; converts their messages to ours
`files`             the files of a bag: kinds, names, order and common metadata
`playback`          `PlayClock`, `ReadAhead`: the time of a playback, and due messages
`writer`            `BagWriter`
`file_series`       the files of a bag that is written, one after another
`writer_checks`     checks of a writer's options, types and messages
`recording`         `Recording`: messages of several threads, written on a background thread
`storage`           the interface of a file of a bag, common to all storages; counts and times
`mcap_storage`      that interface for MCAP files
`sqlite_storage`    that interface for sqlite3 files
`mcap_reader`       the MCAP format: summary, chunks, files without a summary
`mcap_chunks`       chunks of an MCAP file: their records, and chunks to copy as they are
`mapped_files`      files in memory, whose pages are read when they are needed
`record_messages`   the messages among the records of a chunk
`mcap_records`      the records of MCAP as bytes and objects
`mcap_writer`       writes MCAP files
`sqlite_reader`     rosbag2's sqlite3 schema, versions 1 to 4
`sqlite_table`      the rows of its messages, natively
`ros1_storage`      that interface for bags of ROS 1; converts their messages to CDR
`ros1_file`         the format of ROS 1's bags: connections, chunks, bags without an end
`ros1_steps`        the steps of that conversion, for the compiled core
`repair`            `reindex`: repairs a damaged file, or the folder of a recorder that was cut off
`sqlite_writer`     writes sqlite3 files
`metadata`          ``metadata.yaml``, versions 1 to 9; topics that are not in CDR
`qos_yaml`          the QoS of recorded topics as YAML
`definitions`       message definitions in the format of bags
`compression`       zstd and lz4, with limits; files and messages compressed as a whole
==================  ========================================================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.bag.editing import BagOptions, WrittenBags, copy_bag, merge_bags, split_bag
from turtlewire.bag.message import BagMessage
from turtlewire.bag.metadata import TopicInfo
from turtlewire.bag.overview import BagOverview, TopicOverview, describe_bag
from turtlewire.bag.reader import Bag, open_bag
from turtlewire.bag.repair import reindex
from turtlewire.bag.writer import BagWriter

if TYPE_CHECKING:
    from turtlewire.bag.columns import Columns
    from turtlewire.bag.transform_report import TransformReport

__all__ = [
    "Bag",
    "BagMessage",
    "BagOptions",
    "BagOverview",
    "BagWriter",
    "Columns",
    "TopicInfo",
    "TopicOverview",
    "TransformReport",
    "WrittenBags",
    "copy_bag",
    "describe_bag",
    "merge_bags",
    "open_bag",
    "reindex",
    "split_bag",
]


if not TYPE_CHECKING:  # a type checker would accept any name

    def __getattr__(name: str) -> object:
        # They need NumPy, which `ros2 bag info` does not wait for.
        from importlib import import_module

        modules = {"Columns": "columns", "TransformReport": "transform_report"}
        if name not in modules:
            raise AttributeError(f"module 'turtlewire.bag' has no attribute {name!r}")
        found = getattr(import_module(f"turtlewire.bag.{modules[name]}"), name)
        globals()[name] = found
        return found
