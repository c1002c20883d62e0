"""Keeps a student's process away from the grader's memory, files and descriptors, on Linux.

A process can read the memory of the same user's other processes, except those that are not
"dumpable"; a process with root's capabilities can read all. The graders make themselves not
dumpable, and the student's process gives up its capabilities.
"""

from __future__ import annotations

import contextlib
import ctypes
import sys
from collections.abc import Iterator

__all__ = ["give_up_rights", "hidden", "hide"]

# <sys/prctl.h>, <linux/capability.h>
_GET_DUMPABLE, _SET_DUMPABLE, _SET_NO_NEW_PRIVS = 3, 4, 38
_CAPABILITY_VERSION_3 = 0x20080522


def hide() -> None:
    """Close this process's memory, descriptors and environment to other processes permanently."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_SET_DUMPABLE, 0, 0, 0, 0)


@contextlib.contextmanager
def hidden() -> Iterator[None]:
    """Close this process's memory, descriptors and environment to other processes of the user."""
    if sys.platform != "linux":
        yield
        return
    libc = ctypes.CDLL(None)
    before = libc.prctl(_GET_DUMPABLE, 0, 0, 0, 0)
    libc.prctl(_SET_DUMPABLE, 0, 0, 0, 0)
    try:
        yield
    finally:
        libc.prctl(_SET_DUMPABLE, before, 0, 0, 0)


def give_up_rights() -> None:
    """Drop the capabilities of root permanently: with them, no other process would be closed.

    Raises:
        OSError: The system refuses it.
    """
    if sys.platform != "linux":
        return
    libc = ctypes.CDLL(None, use_errno=True)
    header = (ctypes.c_uint32 * 2)(_CAPABILITY_VERSION_3, 0)
    none = (ctypes.c_uint32 * 6)()
    if libc.prctl(_SET_NO_NEW_PRIVS, 1, 0, 0, 0) or libc.capset(header, none):
        raise OSError(ctypes.get_errno(), "the rights of root cannot be given up")
