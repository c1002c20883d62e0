"""Bags: what ROS 2 records, read and written without ROS.

::

    from turtlewire.bag import open_bag

    with open_bag("my_bag") as bag:
        print(bag)
        for message in bag.messages("/odom"):
            print(message.log_time_ns, message.decode())

==================  ========================================================================
module              what it holds
==================  ========================================================================
`reader`            `Bag`, `open_bag`: messages in order of time over all files; `reindex`
`buffers`           `load_transforms`: the TF of a bag in a new buffer
`transforms`        the TF of a bag read into a buffer
`transform_report`  `TransformReport`: its links, and what is wrong with them
`trajectories`      `load_trajectory`: odometry and poses of a topic
`progress`          a line that shows how far something is
`message`           `BagMessage`
`encodings`         topics whose messages are not in CDR
`files`             the files of a bag: names, order, and what they hold together
`playback`          `PlayClock`, `ReadAhead`: the time of a playback and what is due
`writer`            `BagWriter`
`writer_checks`     what it refuses, with a reason
`recording`         `Recording`: messages of several threads, written on a thread of its own
`storage`           one file of a bag, MCAP or sqlite3, behind one interface
`mcap_reader`       the MCAP format: summary, chunks, files without a summary
`chunk_walk`        its chunks, decompressed one ahead of the reader
`mcap_records`      the records of MCAP as bytes and objects
`mcap_writer`       writes MCAP files
`sqlite_reader`     rosbag2's sqlite3 schema, versions 1 to 4
`ros1_reader`       bags of ROS 1, through `rosbags`
`sqlite_writer`     writes sqlite3 files
`metadata`          ``metadata.yaml``, versions 1 to 9
`qos_yaml`          the QoS of recorded topics as YAML
`unpacking`         files and messages that were compressed as a whole
`definitions`       message definitions as bags carry them
`compression`       zstd and lz4, with limits
==================  ========================================================================
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from turtlewire.bag.message import BagMessage
from turtlewire.bag.metadata import BagMetadata, FileInfo, TopicInfo
from turtlewire.bag.reader import Bag, open_bag, reindex
from turtlewire.bag.writer import BagWriter

if TYPE_CHECKING:
    from turtlewire.bag.buffers import load_transforms
    from turtlewire.bag.trajectories import load_trajectory, pose_topics
    from turtlewire.bag.transform_report import Jump, TransformReport

__all__ = [
    "Bag",
    "BagMessage",
    "BagMetadata",
    "BagWriter",
    "FileInfo",
    "Jump",
    "TopicInfo",
    "TransformReport",
    "load_trajectory",
    "load_transforms",
    "open_bag",
    "pose_topics",
    "reindex",
]


#: What needs NumPy, which `ros2 bag info` does not wait for, and the module that has it.
_LOADED_WHEN_USED = {
    "Jump": "transform_report",
    "TransformReport": "transform_report",
    "load_trajectory": "trajectories",
    "load_transforms": "buffers",
    "pose_topics": "trajectories",
}


def __getattr__(name: str) -> object:
    if name not in _LOADED_WHEN_USED:
        raise AttributeError(f"module 'turtlewire.bag' has no attribute {name!r}")
    module = import_module(f"turtlewire.bag.{_LOADED_WHEN_USED[name]}")
    value = globals()[name] = getattr(module, name)
    return value
