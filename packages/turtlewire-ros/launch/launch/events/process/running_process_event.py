"""An event of a process of the launch."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from launch._kernel.protocols import ProcessRunner


class RunningProcessEvent(Event):
    """An event of a process of the launch.

    Args:
        action: The action that runs it.
        name: Its unique name, for example ``turtlesim_node-1``.
        cmd: Its command line.
        cwd: Its working directory, None for that of the launch.
        env: Its environment, None for that of the launch.
        pid: Its process id.
    """

    name = "launch.events.process.RunningProcessEvent"

    def __init__(
        self,
        *,
        action: ProcessRunner,
        name: str,
        cmd: list[str],
        cwd: str | None,
        env: Mapping[str, str] | None,
        pid: int,
    ) -> None:
        self._action = action
        self._process_name = name
        self._cmd = cmd
        self._cwd = cwd
        self._env = env
        self._pid = pid

    @property
    def action(self) -> ProcessRunner:
        """The action that runs the process."""
        return self._action

    @property
    def execute_process_action(self) -> ProcessRunner:
        """The action, under its old name."""
        return self._action

    @property
    def process_name(self) -> str:
        """The process's unique name."""
        return self._process_name

    @property
    def cmd(self) -> list[str]:
        """The command line of the process."""
        return self._cmd

    @property
    def cwd(self) -> str | None:
        """The working directory of the process; None means the directory of the launch."""
        return self._cwd

    @property
    def env(self) -> Mapping[str, str] | None:
        """The environment of the process; None means the environment of the launch."""
        return self._env

    @property
    def pid(self) -> int:
        """The process id."""
        return self._pid
