"""Keeps a student's process away from the grader's memory, files and descriptors, on Linux.

A process may look into others of the same user, unless those hide or the user is root. The graders
hide, and the student's process gives up root's rights.
"""

from __future__ import annotations

import contextlib
import ctypes
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["give_up_rights", "hidden", "hide"]

# <sys/prctl.h>, <linux/capability.h>
_GET_DUMPABLE, _SET_DUMPABLE, _SET_NO_NEW_PRIVS = 3, 4, 38
_CAPABILITY_VERSION_3 = 0x20080522


def hide() -> None:
    """Close this process's memory, descriptors and environment to other processes, for good."""
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
    """Give up the capabilities of root, which open what others hide; for this process, for good.

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
