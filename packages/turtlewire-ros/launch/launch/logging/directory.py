"""The folder of one launch's log files."""

from __future__ import annotations

import contextlib
import os
import socket
import time
from pathlib import Path


def default_log_dir() -> str:
    """Return the parent of launch folders: ``ROS_LOG_DIR``, ``$ROS_HOME/log``, ``~/.ros/log``."""
    explicit = os.environ.get("ROS_LOG_DIR")
    if explicit:
        return str(Path(explicit).expanduser())
    return str(Path(os.environ.get("ROS_HOME") or Path("~") / ".ros").expanduser() / "log")


def make_launch_log_dir(parent: str) -> str:
    """Create a folder named after time, host and process; the link ``latest`` points to it.

    Raises:
        RuntimeError: The folder cannot be created.
    """
    seconds, microseconds = divmod(time.time_ns() // 1000, 1_000_000)
    moment = time.strftime("%Y-%m-%d-%H-%M-%S", time.localtime(seconds))
    name = f"{moment}-{microseconds:06}-{socket.gethostname()}-{os.getpid()}"
    base = Path(parent, name)
    try:
        base.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise RuntimeError(
            f"cannot make the log folder {base} ({error.strerror}); "
            "set ROS_LOG_DIR to another folder"
        ) from error
    # Not every file system has links, and another launch may make it at the same time: logging
    # works without.
    with contextlib.suppress(OSError):
        # A link cannot be changed in one step, but a new one can take its place.
        link = Path(parent) / f".latest-{os.getpid()}"
        link.symlink_to(base.name, target_is_directory=True)
        link.replace(Path(parent) / "latest")
    return str(base)
