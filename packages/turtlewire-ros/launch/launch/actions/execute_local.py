"""Runs a process on this machine until it ends or the launch stops it."""

from __future__ import annotations

import asyncio
import contextlib
import signal
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from launch import logging
from launch.action import ProcessAction
from launch.child_process import ChildProcess, escalate, stdin_is_terminal
from launch.event_handler import EventHandler, entity_list
from launch.event_handlers import OnProcessExit, OnProcessIO, OnShutdown
from launch.events.process import (
    ProcessExited,
    ProcessIO,
    ProcessStarted,
    ProcessStderr,
    ProcessStdout,
    ProcessTargetedEvent,
    ShutdownProcess,
    SignalProcess,
)
from launch.process_output import ProcessOutput
from launch.process_settings import ProcessSettings

if TYPE_CHECKING:
    from launch.descriptions import Executable
    from launch.event import Event
    from launch.events import Shutdown
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


class ExecuteLocal(ProcessAction):
    """Runs a process on this machine.

    At the end of the launch, or when an event asks for it, the process gets SIGINT, then SIGTERM,
    then SIGKILL.

    Args:
        process_description: What is run.
        shell: Whether a shell interprets the command line.
        sigterm_timeout: Seconds between SIGINT and SIGTERM.
        sigkill_timeout: Seconds between SIGTERM and SIGKILL.
        emulate_tty: Whether the process finds a terminal at its output (many programs then show
            colours) and, when the launch runs in a terminal, reads what is typed there, so that a
            launched ``turtle_teleop_key`` works. A launch configuration of this name overrides it.
        output: Where its output goes: ``log`` (stderr also on the screen), ``screen``, ``both``,
            ``own_log``, ``full``, or a mapping.
        output_format: How its lines are shown.
        cached_output: Whether all output is kept for :meth:`get_stdout` and :meth:`get_stderr`.
        log_cmd: Whether the command line is logged at the start.
        on_exit: What to visit at its end: actions, or a function of event and context that returns
            some.
        respawn: Whether it is started again after its end.
        respawn_delay: Seconds before that.
        respawn_max_retries: How often at most; -1 for no limit.
        **kwargs: See :class:`Action`.
    """

    def __init__(
        self,
        *,
        process_description: Executable,
        shell: bool = False,
        sigterm_timeout: SomeSubstitutionsType | float | None = None,
        sigkill_timeout: SomeSubstitutionsType | float | None = None,
        emulate_tty: bool = False,
        output: SomeSubstitutionsType | Mapping[str, Any] = "log",
        output_format: str = "[{this.process_description.final_name}] {line}",
        cached_output: bool = False,
        log_cmd: bool = False,
        on_exit: Any = None,
        respawn: bool | SomeSubstitutionsType = False,
        respawn_delay: float | None = None,
        respawn_max_retries: int = -1,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self._process_description = process_description
        self._shell = shell
        self._settings = ProcessSettings(
            sigterm_timeout=sigterm_timeout,
            sigkill_timeout=sigkill_timeout,
            emulate_tty=emulate_tty,
            respawn=respawn,
        )
        self._output = ProcessOutput(output, cached=cached_output)
        self._output_format = output_format
        self._log_cmd = log_cmd
        self._on_exit = on_exit
        self._respawn_delay = respawn_delay
        self._respawn_max_retries = respawn_max_retries
        self._process: ChildProcess | None = None
        self._process_details: dict[str, Any] | None = None
        self._return_code: int | None = None
        self._completed: asyncio.Future[None] | None = None
        self._shutting_down = asyncio.Event()
        self._end_was_handled = asyncio.Event()

    @property
    def process_description(self) -> Executable:
        """Process that is run."""
        return self._process_description

    @property
    def shell(self) -> bool:
        """True if a shell interprets the command line."""
        return self._shell

    @property
    def emulate_tty(self) -> bool:
        """True if the process finds a terminal at its output."""
        return self._settings.emulate_tty

    @property
    def output(self) -> Any:
        """Destination of the output."""
        return self._output.destination

    @property
    def process_details(self) -> dict[str, Any] | None:
        """Name, cmd, cwd, env and pid of the running process, or None before its start."""
        return self._process_details

    @property
    def return_code(self) -> int | None:
        """Exit status of its last run, negative for a signal; None before its first end."""
        return self._return_code

    @property
    def cached_output(self) -> bool:
        """True if all output is kept."""
        return self._output.cached

    @property
    def sigterm_timeout(self) -> list[Substitution]:
        """Seconds between SIGINT and SIGTERM, as text."""
        return self._settings.sigterm_timeout

    @property
    def sigkill_timeout(self) -> list[Substitution]:
        """Seconds between SIGTERM and SIGKILL, as text."""
        return self._settings.sigkill_timeout

    def get_stdout(self) -> bytes:
        """The stdout of the process; kept only with ``cached_output``."""
        return self._output.kept(1)

    def get_stderr(self) -> bytes:
        """The stderr of the process; kept only with ``cached_output``."""
        return self._output.kept(2)

    def get_asyncio_future(self) -> asyncio.Future[None] | None:
        """Done when the process has ended and is not started again."""
        return self._completed

    def describe_conditional_sub_entities(
        self,
    ) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the actions at the end of the process."""
        if self._on_exit is None or callable(self._on_exit):
            return []
        return [(f"process '{self._process_description.cmd}' exits", entity_list(self._on_exit))]

    # execution

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Start the process; its end completes the action.

        Raises:
            RuntimeError: The action was executed before.
            SubstitutionFailure: A substitution has no value.
            ValueError: A timeout is not a number.
        """
        if self._completed is not None:
            raise RuntimeError(
                f"ExecuteLocal action '{self._process_description.final_name}': "
                f"executed more than once: {self.describe()}"
            )
        # A handler's action may come after the shutdown, which would not stop the process any more.
        if context.is_shutdown:
            return None
        try:
            self.prepare(context)
            self._settings.perform(context, self._name)
        except BaseException:
            self.clean_up()
            raise
        assert context.asyncio_loop is not None
        self._logger = logging.get_logger(self._name)
        self._output.open(
            context, self._name, lambda line: self._output_format.format(line=line, this=self)
        )
        self._completed = context.asyncio_loop.create_future()
        # Before the start, because the first event must find them.
        self._register_handlers(context)
        context.add_completion_future(context.asyncio_loop.create_task(self._run(context)))
        return None

    def prepare(self, context: LaunchContext) -> None:
        """Perform the substitutions of the command line."""
        self._process_description.prepare(context, self)

    def command(self) -> list[str]:
        """The program and arguments to start; logs show the command line of the description."""
        assert self._process_description.final_cmd is not None
        return self._process_description.final_cmd

    def clean_up(self) -> None:
        """Remove what was made for the process.

        Called once: after its last end, or when it could not be prepared.
        """

    @property
    def _name(self) -> str:
        assert self._process_description.final_name is not None
        return self._process_description.final_name

    async def _run(self, context: LaunchContext) -> None:
        try:
            runs = 0
            while await self._run_once(context) and await self._respawns(runs):
                runs += 1
        finally:
            self.clean_up()
            if self._completed is not None and not self._completed.done():
                self._completed.set_result(None)

    async def _run_once(self, context: LaunchContext) -> bool:
        """Run the process and the handlers of its end; returns whether it could be started."""
        self._end_was_handled.clear()
        try:
            self._process = process = await self._start(context)
        except OSError as error:
            text = "exception occurred while executing process: %s"
            self._logger.error(text, error)  # noqa: TRY400  a traceback would show our code only
            return False
        await context.emit_event(ProcessStarted(action=self, **self._event_details()))
        # The launch may have ended while the process was starting, too early for a signal.
        if self._shutting_down.is_set():
            self._stop(context, send_sigint=True)
        try:
            self._return_code = await process.wait()
            await process.read_rest()
        finally:
            process.close()
        await context.emit_event(
            ProcessExited(action=self, returncode=self._return_code or 0, **self._event_details())
        )
        # A respawn must not overtake the last lines of this run, nor a handler that shuts down.
        await self._end_was_handled.wait()
        return True

    async def _start(self, context: LaunchContext) -> ChildProcess:
        description = self._process_description
        assert description.final_cmd is not None
        assert description.final_env is not None
        if self._log_cmd:
            self._logger.info(
                "process details: cmd='%s', cwd='%s'",
                " ".join(description.final_cmd),
                description.final_cwd,
            )
        emulate_tty = self._settings.emulates_tty
        return await ChildProcess.start(
            self.command(),
            cwd=description.final_cwd,
            # Without it, the output of a Python node would only appear after its end.
            env=context.marked_environment({"PYTHONUNBUFFERED": "1", **description.final_env}),
            shell=self._shell,
            inherit_stdin=emulate_tty and not context.noninteractive and stdin_is_terminal(),
            emulate_tty=emulate_tty,
            on_start=self._on_start,
            on_output=lambda fd, data: self._on_output(context, fd, data),
        )

    def _on_start(self, pid: int) -> None:
        description = self._process_description
        self._process_details = {
            "name": self._name,
            "cmd": description.final_cmd,
            "cwd": description.final_cwd,
        }
        self._process_details |= {"env": description.final_env, "pid": pid}
        self._logger.info("process started with pid [%s]", pid)

    async def _respawns(self, runs: int) -> bool:
        """Wait until the next start is due; return False without a further start."""
        if not self._settings.respawns or 0 <= self._respawn_max_retries <= runs:
            return False
        with contextlib.suppress(asyncio.TimeoutError):
            await asyncio.wait_for(self._shutting_down.wait(), self._respawn_delay or 0.0)
        return not self._shutting_down.is_set()

    # events

    def _register_handlers(self, context: LaunchContext) -> None:
        """Register for all events of the process; the last one gets an event first."""
        on_exit = [] if self._on_exit is None else self._on_exit
        # The last lines are shown before the user's `on_exit` is visited.
        for handler in (
            OnProcessExit(target_action=self, on_exit=on_exit),
            OnProcessExit(target_action=self, on_exit=self._show_end),
            OnProcessIO(
                target_action=self,
                on_stdin=self._on_stdin,
                on_stdout=self._show_output,
                on_stderr=self._show_output,
            ),
            OnShutdown(on_shutdown=self._on_shutdown),
            EventHandler(matcher=self._is_for_me, entities=self._on_targeted_event),
        ):
            context.register_event_handler(handler)

    def _is_for_me(self, event: Event) -> bool:
        return isinstance(event, ProcessTargetedEvent) and event.process_matcher(self)

    def _on_targeted_event(self, event: Event, context: LaunchContext) -> None:
        if isinstance(event, SignalProcess):
            self._send_signal(event.signal)
        elif isinstance(event, ShutdownProcess):
            self._shutdown_process(context, send_sigint=True)

    def _on_stdin(self, event: ProcessIO) -> None:
        if self._process is not None:
            self._process.write(event.text)

    def _event_details(self) -> dict[str, Any]:
        assert self._process_details is not None
        return dict(self._process_details)

    # output

    def _on_output(self, context: LaunchContext, fd: int, data: bytes) -> None:
        self._output.keep(fd, data)
        event_class = ProcessStdout if fd == 1 else ProcessStderr
        context.emit_event_sync(event_class(text=data, action=self, **self._event_details()))

    def _show_output(self, event: ProcessIO) -> None:
        self._output.show(1 if event.from_stdout else 2, event.text)

    def _show_end(self, event: ProcessExited, _context: LaunchContext) -> None:
        """Show the last line, even if it is not complete, and how the process ended."""
        self._end_was_handled.set()
        self._output.show_rest()
        if event.returncode == 0:
            self._logger.info("process has finished cleanly [pid %s]", event.pid)
        else:
            self._logger.error(
                "process has died [pid %s, exit code %s, cmd '%s'].",
                event.pid,
                event.returncode,
                " ".join(event.cmd),
            )

    # the end

    def _on_shutdown(self, event: Shutdown, context: LaunchContext) -> None:
        # At Ctrl-C a terminal has sent SIGINT to its whole process group already.
        self._shutdown_process(
            context, send_sigint=not event.due_to_sigint or context.noninteractive
        )

    def _shutdown_process(self, context: LaunchContext, *, send_sigint: bool) -> None:
        if not self._shutting_down.is_set():
            self._shutting_down.set()
            self._stop(context, send_sigint=send_sigint)

    def _stop(self, context: LaunchContext, *, send_sigint: bool) -> None:
        if self._process is None or not self._process.running:
            return
        if send_sigint:
            self._send_signal(signal.SIGINT)
        timeouts = self._settings.timeouts(context, self._logger)
        end = escalate(self._process, self._name, timeouts, self._send_signal, self._logger)
        context.add_completion_future(asyncio.ensure_future(end))

    def _send_signal(self, number: signal.Signals) -> None:
        process = self._process
        if process is None or not process.running:
            return
        self._logger.info("sending signal '%s' to process[%s]", number.name, self._name)
        process.send_signal(number)
