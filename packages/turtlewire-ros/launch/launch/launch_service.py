"""Runs launch descriptions: the event loop, the order of events, signals."""

from __future__ import annotations

import asyncio
import contextlib
import signal
import sys
import threading
import traceback
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

from launch import logging
from launch._kernel.run import Run
from launch.event_handlers import OnIncludeLaunchDescription, OnShutdown
from launch.events import IncludeLaunchDescription, Shutdown
from launch.launch_context import LaunchContext
from launch.utilities.raised_in import raised_in
from turtlewire.terminal.signal_watch import watched
from turtlewire_ros.workspace_hints import path_hint

if TYPE_CHECKING:
    from launch._kernel.protocols import Visitable
    from launch.event import Event
    from launch.launch_description import LaunchDescription

# Interrupt a hanging launch file after this many Ctrl-C that the loop did not handle.
_PATIENCE = 3


class LaunchService:
    """Runs launch descriptions until all processes have ended or :meth:`shutdown` is called.

    Events are handled one after the other. An exception that an entity raises shuts the launch
    down; :meth:`run` then returns 1.

    Args:
        argv: Arguments of the launch.
        noninteractive: Whether no user watches it at a terminal. Children then get no SIGINT from
            a terminal, and the launch sends them one.
        debug: Log at DEBUG level.
        log_file_name: Name of the file for the lines of this launch, and of the processes whose
            output is ``log``.
    """

    def __init__(
        self,
        *,
        argv: Iterable[str] | None = None,
        noninteractive: bool = False,
        debug: bool = False,
        log_file_name: str = "launch.log",
    ) -> None:
        logging.launch_config.main_log_file_name = log_file_name
        logging.launch_config.level = logging.DEBUG if debug else logging.INFO
        self._run: Run[LaunchContext] = Run()
        self._context = LaunchContext(argv=argv, noninteractive=noninteractive, run=self._run)
        self._logger = logging.get_logger("launch")
        self._context.register_event_handler(OnIncludeLaunchDescription())
        self._context.register_event_handler(OnShutdown(on_shutdown=self._on_shutdown))
        self._running = threading.Lock()
        # The first reason for a shutdown acquires it, on any thread.
        self._may_shut_down = threading.Lock()
        self._interrupted = False
        self._unseen_interrupts = 0
        self._return_code = 0
        self._task: asyncio.Task[int] | None = None

    @property
    def context(self) -> LaunchContext:
        """The context of this launch."""
        return self._context

    @property
    def event_loop(self) -> asyncio.AbstractEventLoop | None:
        """The loop it runs on, or None when it does not run."""
        return self._run.loop

    @property
    def task(self) -> asyncio.Task[int] | None:
        """The task that runs it, or ran it last; None before its first run."""
        return self._task

    def include_launch_description(self, launch_description: LaunchDescription) -> None:
        """Visit a description as soon as the launch runs. Safe from any thread."""
        self.emit_event(IncludeLaunchDescription(launch_description))

    def emit_event(self, event: Event) -> None:
        """Queue an event. Safe from any thread."""
        self._context.emit_event_sync(event)

    def shutdown(self, force_sync: bool = False) -> None:
        """Stop all processes and end the launch, so that :meth:`run` returns.

        Safe from any thread.

        Args:
            force_sync: As in ROS 2; the event is queued in either case.
        """
        del force_sync
        self._shut_down("LaunchService.shutdown() called", due_to_sigint=False)

    def run(self, *, shutdown_when_idle: bool = True) -> int:
        """Run to the end.

        Args:
            shutdown_when_idle: End when nothing is left to do.

        Returns:
            0, or 1 when the launch itself failed. Failures of launched processes do not count.
        """
        loop = asyncio.new_event_loop()
        try:
            return loop.run_until_complete(self.run_async(shutdown_when_idle=shutdown_when_idle))
        finally:
            loop.run_until_complete(_cancel_other_tasks())
            loop.run_until_complete(loop.shutdown_asyncgens())
            loop.run_until_complete(loop.shutdown_default_executor())
            loop.close()

    async def run_async(self, *, shutdown_when_idle: bool = True) -> int:
        """Return the same as :meth:`run`, on the running loop."""
        if not self._running.acquire(blocking=False):
            raise RuntimeError("LaunchService cannot be run multiple times concurrently.")
        try:
            self._run.begin()
            self._task = asyncio.current_task()
            self._return_code = self._unseen_interrupts = 0
            self._interrupted = False
            with self._signals_handled():
                logging.log_launch_config(logger=self._logger)
                await self._serve_to_the_end(shutdown_when_idle)
            return self._return_code
        finally:
            self._run.end()
            self._may_shut_down = threading.Lock()
            self._running.release()

    async def _serve_to_the_end(self, shutdown_when_idle: bool) -> None:
        try:
            try:
                await self._serve(shutdown_when_idle)
            except asyncio.CancelledError:
                self._shut_down("the task of the launch was cancelled", due_to_sigint=False)
                await self._serve(shutdown_when_idle)
                raise
            finally:
                # Stop everything that the launched processes have left behind; after the third
                # Ctrl-C or a second cancellation also the processes themselves.
                await self._run.stop_processes()
        except BaseException:
            try:
                if not self._run.is_shutdown:
                    self._process_event(Shutdown(reason="interrupted", due_to_sigint=True))
            finally:
                await self._run.cancel_rest()
            raise

    async def _serve(self, shutdown_when_idle: bool) -> None:
        while True:
            for error in self._run.take_errors():
                self._fail(error)
            events = self._run.take_events()
            for event in events:
                self._process_event(event)
            if events:
                # Tasks that the events started run before the next check for idleness.
                await asyncio.sleep(0)
            elif self._run.is_busy or not (self._run.is_shutdown or shutdown_when_idle):
                await self._run.wait()
            elif self._run.is_shutdown:
                return
            # As an event, so that handlers of the shutdown run as for any other reason.
            elif self._may_shut_down.acquire(blocking=False):
                await self._context.emit_event(Shutdown(reason="idle", due_to_sigint=False))
            else:  # the event of another thread may not be in the queue yet
                await self._run.wait()

    def _process_event(self, event: Event) -> None:
        self._logger.debug("processing event: '%s'", event)
        # A copy: handlers register and unregister others.
        for handler in self._run.handlers():
            if not handler.matches(event):
                continue
            self._logger.debug("processing event: '%s' ✓ '%s'", event, handler)
            # What a handler sets for its event (`context.locals`) must not outlive it.
            self._context.local_scopes.push()
            try:
                for entity in _entities(handler.handle(event, self._context)):
                    self._visit(entity)
            # Launch files may raise anything. A cancellation of the task never comes here.
            except (Exception, asyncio.CancelledError) as error:  # noqa: BLE001
                self._fail(error)
            finally:
                self._context.local_scopes.pop()

    def _visit(self, entity: Visitable[LaunchContext]) -> None:
        sub_entities = entity.visit(self._context)
        future = entity.get_asyncio_future()
        if future is not None:
            self._run.keep_running_for(future)
        for sub_entity in sub_entities or ():
            self._visit(sub_entity)

    def _fail(self, error: BaseException) -> None:
        self._logger.debug(
            "%s", "".join(traceback.format_exception(type(error), error, error.__traceback__))
        )
        hint = getattr(error, "hint", "")
        if isinstance(error, FileNotFoundError):
            hint = path_hint(str(error.filename))
        self._logger.error(
            "Caught exception in launch (see debug for traceback): %s%s%s",
            *(error, f"\n{hint}" if hint else "", raised_in(error)),
        )
        self._return_code = 1
        self._shut_down(
            f"Caught exception in launch (see debug for traceback): {error}", due_to_sigint=False
        )

    def _shut_down(self, reason: str, *, due_to_sigint: bool) -> None:
        if not self._run.is_shutdown and self._may_shut_down.acquire(blocking=False):
            self.emit_event(Shutdown(reason=reason, due_to_sigint=due_to_sigint))

    def _on_shutdown(self, _event: Event, _context: LaunchContext) -> None:
        self._run.is_shutdown = True

    # signals

    @contextlib.contextmanager
    def _signals_handled(self) -> Iterator[None]:
        r"""Handle Ctrl-C, Ctrl-\\, SIGTERM and SIGHUP in the block; only the main thread can."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        loop = asyncio.get_running_loop()
        handlers = self._signal_handlers()

        def hand_to_loop(number: int, _frame: object) -> None:
            # A loop that a callback blocks never sees the signal; the third Ctrl-C breaks it.
            if number == signal.SIGINT:
                self._unseen_interrupts += 1
                if self._unseen_interrupts == _PATIENCE:
                    raise KeyboardInterrupt
            loop.call_soon_threadsafe(handlers[number])

        # Not `loop.add_signal_handler`: Windows has none, and a blocked loop would never see the
        # third Ctrl-C.
        before = {number: signal.signal(number, hand_to_loop) for number in handlers}
        try:
            # A loop that sleeps may miss a signal; a call from another thread wakes it.
            with watched(handlers, lambda: loop.call_soon_threadsafe(lambda: None)):
                yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)

    def _signal_handlers(self) -> dict[int, Callable[[], None]]:
        """Return the functions that the loop calls, by the numbers of the signals."""
        handlers: dict[int, Callable[[], None]] = {
            signal.SIGINT: self._on_sigint,
            signal.SIGTERM: self._on_sigterm,
        }
        if sys.platform != "win32":
            handlers[signal.SIGQUIT] = self._on_sigquit
            if signal.getsignal(signal.SIGHUP) != signal.SIG_IGN:  # `nohup` ignores it
                handlers[signal.SIGHUP] = self._on_sighup
        return handlers

    def _on_sigint(self) -> None:
        self._unseen_interrupts = 0
        if self._interrupted:
            self._logger.warning("user interrupted with ctrl-c (SIGINT) again, ignoring...")
            return
        self._interrupted = True
        self._logger.warning("user interrupted with ctrl-c (SIGINT)")
        self._shut_down("ctrl-c (SIGINT)", due_to_sigint=True)

    def _on_sigterm(self) -> None:
        self._terminate("SIGTERM")

    def _on_sigquit(self) -> None:
        self._terminate("SIGQUIT")

    def _on_sighup(self) -> None:
        self._logger.error("the terminal was closed (SIGHUP), terminating...")
        self._return_code = 1
        self._shut_down("SIGHUP", due_to_sigint=False)

    def _terminate(self, name: str) -> None:
        self._logger.error("user interrupted with ctrl-\\ (%s), terminating...", name)
        self._return_code = 1
        self._shut_down(f"ctrl-\\ ({name})", due_to_sigint=False)


async def _cancel_other_tasks() -> None:
    """End what still runs when an exception, such as KeyboardInterrupt, has ended the launch."""
    tasks = asyncio.all_tasks() - {asyncio.current_task()}
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)


def _entities(
    handled: Visitable[LaunchContext] | Iterable[Visitable[LaunchContext]] | None,
) -> list[Visitable[LaunchContext]]:
    """Return a handler's result as a list."""
    if handled is None:
        return []
    return list(handled) if isinstance(handled, Iterable) else [handled]
