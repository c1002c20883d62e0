"""Ends every process that a command started, directly or not, when the command ends.

A process that SIGKILL ends cannot stop its children, and a grandchild loses its link to the command
when the child ends. On Linux a :class:`ProcessFamily` therefore marks the environment of its
children, which all their descendants inherit, and starts a guardian
(:mod:`turtlewire_ros.process_guardian`) that outlives the command. Other systems do not show the
environment of other processes: there a command stops only its own children, when it ends in order.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping

from turtlewire_ros import process_guardian


class ProcessFamily:
    """The descendants of one command. Not thread-safe.

    Start children between :meth:`start` and :meth:`stop`, each with an environment from
    :meth:`marked`.
    """

    def __init__(self) -> None:
        self._name = f"{os.getpid()}-{os.urandom(8).hex()}"
        self._guardian: subprocess.Popen[bytes] | None = None

    def marked(self, environment: Mapping[str, str]) -> dict[str, str]:
        """Return the environment for a child: ``environment`` and the mark of this family."""
        outer = os.environ.get(process_guardian.FAMILIES)
        # A launch inside a launch belongs to both families.
        names = self._name if outer is None else f"{outer}:{self._name}"
        return {**environment, process_guardian.FAMILIES: names}

    def start(self) -> None:
        """Start the guardian."""
        if sys.platform == "linux":
            self._guardian = subprocess.Popen(  # noqa: S603  our own file
                [sys.executable, "-I", "-S", process_guardian.__file__, self._name],
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                # The guardian must ignore Ctrl-C, hang-ups and signals to the process group.
                start_new_session=True,
            )

    def stop(self) -> None:
        """Send what is left of the family SIGTERM, and SIGKILL five seconds later; wait for it."""
        if self._guardian is not None:
            self._guardian.communicate()  # closes its stdin, which is the signal to begin
            self._guardian = None
