"""Recorder, player and their options under the name of rosbag2's compiled module."""

from rosbag2_py._player import Player
from rosbag2_py._recorder import Recorder
from rosbag2_py._rewrite import bag_rewrite
from rosbag2_transport.options import (
    MessageOrder,
    PlayOptions,
    RecordOptions,
    ServiceRequestsSource,
)

__all__ = [
    "MessageOrder",
    "PlayOptions",
    "Player",
    "RecordOptions",
    "Recorder",
    "ServiceRequestsSource",
    "bag_rewrite",
]
