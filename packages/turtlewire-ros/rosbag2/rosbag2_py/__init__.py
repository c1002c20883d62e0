"""rosbag2's Python interface, on turtlewire's bags.

==================================  ============================================================
module                              contents
==================================  ============================================================
`_reader`, `_writer`                readers and writers, message by message; presets of storages
`_info`                             reads metadata; counts requests and responses
`_recorder`, `_player`              recording and playing as scripts start it
`_rewrite`                          converting bags as a YAML file asks
`_transport`                        these three modules under the name that scripts import
`_metadata`                         `BagMetadata`, and the text of ``ros2 bag info``
`_storage`, `_compression_options`  options; the engine's types translated
`_reindexer`                        rebuilds ``metadata.yaml``
`_message_definitions`              definitions of types from this installation
==================================  ============================================================
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from rosbag2_py._compression_options import (
    CompressionMode,
    CompressionOptions,
    compression_mode_from_string,
    compression_mode_to_string,
)
from rosbag2_py._info import Info
from rosbag2_py._message_definitions import LocalMessageDefinitionSource
from rosbag2_py._metadata import BagMetadata, FileInformation, TopicInformation, TopicMetadata
from rosbag2_py._reader import (
    SequentialCompressionReader,
    SequentialReader,
    get_registered_readers,
)
from rosbag2_py._reindexer import Reindexer
from rosbag2_py._storage import (
    ConverterOptions,
    MessageDefinition,
    MetadataIo,
    ReadOrder,
    ReadOrderSortBy,
    StorageFilter,
    StorageOptions,
    convert_rclcpp_qos_to_rclpy_qos,
    get_default_storage_id,
    to_rclcpp_qos_vector,
)
from rosbag2_py._writer import (
    SequentialCompressionWriter,
    SequentialWriter,
    get_registered_compressors,
    get_registered_serializers,
    get_registered_writers,
)
from rosbag2_transport.options import (
    MessageOrder,
    PlayOptions,
    RecordOptions,
    ServiceRequestsSource,
)

if TYPE_CHECKING:
    from rosbag2_py._player import Player
    from rosbag2_py._recorder import Recorder
    from rosbag2_py._rewrite import bag_rewrite

__all__ = [
    "BagMetadata",
    "CompressionMode",
    "CompressionOptions",
    "ConverterOptions",
    "FileInformation",
    "Info",
    "LocalMessageDefinitionSource",
    "MessageDefinition",
    "MessageOrder",
    "MetadataIo",
    "PlayOptions",
    "Player",
    "ReadOrder",
    "ReadOrderSortBy",
    "RecordOptions",
    "Recorder",
    "Reindexer",
    "SequentialCompressionReader",
    "SequentialCompressionWriter",
    "SequentialReader",
    "SequentialWriter",
    "ServiceRequestsSource",
    "StorageFilter",
    "StorageOptions",
    "TopicInformation",
    "TopicMetadata",
    "bag_rewrite",
    "compression_mode_from_string",
    "compression_mode_to_string",
    "convert_rclcpp_qos_to_rclpy_qos",
    "get_default_storage_id",
    "get_registered_compressors",
    "get_registered_readers",
    "get_registered_serializers",
    "get_registered_writers",
    "to_rclcpp_qos_vector",
]

#: Loaded when they are used: reading a bag needs neither a node nor the network.
_LAZY = {"Player": "_player", "Recorder": "_recorder", "bag_rewrite": "_rewrite"}


def __getattr__(name: str) -> Any:
    if name not in _LAZY:
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    return getattr(import_module(f"{__name__}.{_LAZY[name]}"), name)
