"""ROS 2's daemon, which keeps the graph for other commands: here it never runs.

Each command discovers the nodes itself, in about the time that a daemon would take to answer.
Programs that ask for the daemon are told that none runs, and use a direct node as they do with
``--no-daemon``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse
    from types import TracebackType

__all__ = ["DaemonNode", "add_arguments", "is_daemon_running", "shutdown_daemon", "spawn_daemon"]


class DaemonNode:
    """A connection to the daemon, which is never made.

    Args:
        args: The command line.
    """

    def __init__(self, args: argparse.Namespace | None) -> None:
        self._args = args

    @property
    def connected(self) -> bool:
        """True if there is a daemon: no."""
        return False

    @property
    def methods(self) -> list[str]:
        """Names of the functions that the daemon offers.

        Raises:
            ConnectionRefusedError: Always, as in ROS 2 when the daemon does not run.
        """
        raise ConnectionRefusedError("there is no daemon: use ros2cli.node.direct.DirectNode")

    def __enter__(self) -> DaemonNode:  # noqa: PYI034  Self is not in Python 3.10
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_value: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        pass


def is_daemon_running(args: argparse.Namespace | None) -> bool:  # noqa: ARG001
    """Return True if the daemon runs: no."""
    return False


def shutdown_daemon(
    args: argparse.Namespace | None,  # noqa: ARG001
    timeout: float | None = None,  # noqa: ARG001
) -> bool:
    """Return True if a daemon was stopped: there was none."""
    return False


def spawn_daemon(
    args: argparse.Namespace | None,  # noqa: ARG001
    timeout: float | None = None,  # noqa: ARG001
    debug: bool = False,  # noqa: ARG001
) -> bool:
    """Return True if a daemon was started: always False, because commands need no daemon."""
    return False


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``--no-daemon``, which is accepted for compatibility."""
    from ros2cli.arguments import add_arguments as add
    from ros2cli.discovery import STRATEGY_ARGUMENTS

    add(parser, STRATEGY_ARGUMENTS[-1:])
