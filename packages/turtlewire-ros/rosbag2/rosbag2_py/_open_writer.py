"""Opens a bag for writing as storage options ask: presets and configuration files."""

from __future__ import annotations

import os
import sqlite3
from typing import TYPE_CHECKING, Any

from rclpy.logging import get_logger
from turtlewire.bag import BagWriter
from turtlewire.bag.qos_yaml import load_yaml
from turtlewire.distro import current_distro
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from rosbag2_py._storage import StorageOptions

# rosbag2's limits in bytes.
_SMALLEST_SPLIT = {"mcap": 1024, "sqlite3": 86_016}

#: What the presets of MCAP mean.
PRESETS: dict[str, dict[str, Any]] = {
    "": {},
    "none": {},
    "fastwrite": {"checksums": False},
    "zstd_fast": {"compression": "zstd", "level": -5, "checksums": False},
    "zstd_small": {"compression": "zstd", "level": 19, "chunk_bytes": 4 << 20},
}
#: The presets of sqlite3, whose files always survive a killed process.
_SQLITE_PRESETS = ("", "none", "resilient")

_MESSAGE_COMPRESSION = (
    "MCAP storage plugin does not support message compression, consider using chunk compression "
    "by setting `compression: 'Zstd'` in storage config"
)

_COMPRESSIONS = {"None": "", "Lz4": "lz4", "Zstd": "zstd"}
_LEVELS = {"Fastest": -5, "Fast": -3, "Default": 1, "Slow": 5, "Slowest": 19}
#: Keys of a configuration of MCAP that change nothing here: indexes and summary are always written.
_WITHOUT_EFFECT = {
    *("noAttachmentCRC", "enableDataCRC", "noSummaryCRC", "noChunking", "noMessageIndex"),
    *("noSummary", "forceCompression", "noRepeatedSchemas", "noRepeatedChannels"),
    *("noAttachmentIndex", "noMetadataIndex", "noChunkIndex", "noStatistics", "noSummaryOffsets"),
}


def make_writer(storage_options: StorageOptions, compression_mode: str) -> BagWriter:
    """Return a new bag.

    Args:
        storage_options: Where and how.
        compression_mode: ``FILE``, ``MESSAGE`` or empty.

    Raises:
        RuntimeError: The bag already exists, or the options are incompatible.
    """
    storage = storage_options.storage_id or "mcap"
    size = storage_options.max_bagfile_size
    if size and size < (smallest := _SMALLEST_SPLIT.get(storage, 0)):
        raise RuntimeError(
            "Invalid bag splitting size given. "
            f"Please provide a value greater than {smallest}. Specified value of {size}"
        )
    if compression_mode == "MESSAGE" and storage == "mcap":
        raise RuntimeError(_MESSAGE_COMPRESSION)
    try:
        writer = BagWriter(
            storage_options.uri,
            storage=storage,
            compression_mode=compression_mode,
            max_file_bytes=size,
            max_file_ns=storage_options.max_bagfile_duration * 1_000_000_000,
            max_files=storage_options.max_bag_files,
            custom_data=storage_options.custom_data,
            ros_distro=str(current_distro()),
            **(_mcap_options(storage_options) if storage == "mcap" else {}),
        )
    except FileExistsError as error:
        raise RuntimeError(
            f"Bag directory already exists ({storage_options.uri}), can't overwrite existing bag"
        ) from error
    except OSError as error:
        raise RuntimeError(f"cannot make the bag {storage_options.uri}: {error}") from error
    except (BagError, sqlite3.Error) as error:
        raise RuntimeError(str(error)) from error
    if storage == "sqlite3":
        if storage_options.storage_preset_profile not in _SQLITE_PRESETS:
            get_logger("rosbag2_storage").warning(
                f"sqlite3 has no preset profile '{storage_options.storage_preset_profile}', "
                "which is ignored; it has none and resilient"
            )
        path = os.path.join(storage_options.uri, os.path.basename(writer.file_path))
        get_logger("rosbag2_storage").info(f"Opened database '{path}' for READ_WRITE.")
    return writer


def _mcap_options(storage_options: StorageOptions) -> dict[str, Any]:
    preset = storage_options.storage_preset_profile
    if preset not in PRESETS:
        raise RuntimeError(
            f"unknown MCAP storage preset profile '{preset}'; choose from "
            f"{', '.join(name for name in PRESETS if name)}"
        )
    options = dict(PRESETS[preset])
    if storage_options.storage_config_uri:
        options.update(_configuration(storage_options.storage_config_uri))
    return options


def _configuration(path: str) -> dict[str, Any]:
    """Read a file with options of MCAP."""
    with open(path, encoding="utf-8") as file:
        content = load_yaml(file.read(), path) or {}
    if not isinstance(content, dict):
        raise BagError(f"{path}: expected keys and values, got a {type(content).__name__}")
    options: dict[str, Any] = {}
    for key, value in content.items():
        if key == "compression":
            options["compression"] = _choice(path, key, value, _COMPRESSIONS)
        elif key == "compressionLevel":
            options["level"] = _choice(path, key, value, _LEVELS)
        elif key == "chunkSize":
            options["chunk_bytes"] = int(value)
        elif key == "noChunkCRC":
            options["checksums"] = not value
        elif key not in _WITHOUT_EFFECT:
            raise BagError(f"{path}: unknown key '{key}'")
    return options


def _choice(path: str, key: str, value: Any, choices: dict[str, Any]) -> Any:
    if value not in choices:
        raise BagError(f"{path}: {key} is one of {', '.join(choices)}, not {value!r}")
    return choices[value]
