"""What the parts of a running launch share: events and handlers, configurations, environment, locals."""

from __future__ import annotations

import collections
import os
from typing import TYPE_CHECKING, Any

from launch import logging
from turtlewire_ros.process_family import ProcessFamily

if TYPE_CHECKING:
    import asyncio
    from collections.abc import Callable, Iterable, Mapping, MutableMapping

    from launch.event import Event
    from launch.event_handler import BaseEventHandler
    from launch.substitution import Substitution

__all__ = ["LaunchContext"]


class _Locals:
    """Read access to the locals as attributes."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        self._values = values

    def __getattr__(self, name: str) -> Any:
        """Return the local of that name."""
        if name not in self._values:
            raise AttributeError(
                f"context.locals has no attribute '{name}', available attributes: {sorted(self._values)}"
            )
        return self._values[name]


class LaunchContext:
    """Belongs to one launch. All methods are for the thread of its event loop, except for :meth:`emit_event_sync` and :meth:`emit_event`.

    Args:
        argv: Arguments of the launch.
        noninteractive: Whether nobody at a terminal watches it.
    """

    def __init__(self, *, argv: Iterable[str] | None = None, noninteractive: bool = False) -> None:
        self._argv = list(argv or ())
        self._noninteractive = noninteractive
        self._events: collections.deque[Event] = collections.deque()
        self._event_handlers: collections.deque[BaseEventHandler] = collections.deque()
        self._on_event: Callable[[], None] = lambda: None
        self._on_completion_future: Callable[[asyncio.Future[Any]], None] = lambda _: None
        self._asyncio_loop: asyncio.AbstractEventLoop | None = None
        self._is_shutdown = False
        self._launch_configurations: dict[str, str] = {}
        self._configuration_stack: list[dict[str, str]] = []
        self._environment_at_start = dict(os.environ)
        self._environment_stack: list[dict[str, str]] = []
        self._globals: dict[str, Any] = {}
        self._locals: dict[str, Any] = {}
        self._locals_stack: list[dict[str, Any]] = []
        self._process_family: ProcessFamily | None = None
        self._logger = logging.get_logger("launch.launch_context")

    @property
    def argv(self) -> list[str]:
        """Arguments of the launch."""
        return self._argv

    @property
    def noninteractive(self) -> bool:
        """Whether nobody at a terminal watches the launch."""
        return self._noninteractive

    @property
    def is_shutdown(self) -> bool:
        """Whether the launch is ending."""
        return self._is_shutdown

    @property
    def asyncio_loop(self) -> asyncio.AbstractEventLoop | None:
        """The event loop that the launch runs on, or None before it runs."""
        return self._asyncio_loop

    # events

    def register_event_handler(self, event_handler: BaseEventHandler, append: bool = False) -> None:
        """Add a handler: before all others, or after them."""
        if append:
            self._event_handlers.append(event_handler)
        else:
            self._event_handlers.appendleft(event_handler)

    def unregister_event_handler(self, event_handler: BaseEventHandler) -> None:
        """Remove a handler.

        Raises:
            ValueError: It is not registered.
        """
        self._event_handlers.remove(event_handler)

    def would_handle_event(self, event: Event) -> bool:
        """Whether some handler waits for such an event."""
        return any(handler.matches(event) for handler in self._event_handlers)

    def emit_event_sync(self, event: Event) -> None:
        """Queue an event; its handlers run later on the loop. Safe from any thread."""
        self._logger.debug("emitting event synchronously: '%s'", event.name)
        self._queue_event(event)

    async def emit_event(self, event: Event) -> None:
        """Queue an event; its handlers run later on the loop."""
        self._logger.debug("emitting event: '%s'", event.name)
        self._queue_event(event)

    def _queue_event(self, event: Event) -> None:
        self._events.append(event)
        self._on_event()

    def add_completion_future(self, completion_future: asyncio.Future[Any]) -> None:
        """Keep the launch running until the future is done."""
        self._on_completion_future(completion_future)

    def marked_environment(self, environment: Mapping[str, str]) -> dict[str, str]:
        """The environment for a child process, which ends with the launch by that."""
        if self._process_family is None:
            self._process_family = ProcessFamily().__enter__()
        return self._process_family.marked(environment)

    def end_processes(self) -> None:
        """Stop what launched processes have left behind; returns when it has ended."""
        if self._process_family is not None:
            self._process_family.__exit__()
            self._process_family = None

    # launch configurations, environment, locals

    @property
    def launch_configurations(self) -> dict[str, str]:
        """The launch configurations; change them through actions or here."""
        return self._launch_configurations

    @property
    def environment(self) -> MutableMapping[str, str]:
        """The environment variables of this process, which its children inherit."""
        return os.environ

    def _push_launch_configurations(self) -> None:
        self._configuration_stack.append(dict(self._launch_configurations))

    def _pop_launch_configurations(self) -> None:
        if not self._configuration_stack:
            raise RuntimeError("launch configurations stack unexpectedly empty")
        self._launch_configurations.clear()
        self._launch_configurations.update(self._configuration_stack.pop())

    def _push_environment(self) -> None:
        self._environment_stack.append(dict(os.environ))

    def _pop_environment(self) -> None:
        if not self._environment_stack:
            raise RuntimeError("environment stack unexpectedly empty")
        _replace_environment(self._environment_stack.pop())

    def _reset_environment(self) -> None:
        _replace_environment(self._environment_at_start)

    def extend_globals(self, extensions: Mapping[str, Any]) -> None:
        """Add locals that are there during all visits."""
        self._globals.update(extensions)

    def extend_locals(self, extensions: Mapping[str, Any]) -> None:
        """Add locals for the visits that belong to the present event."""
        self._locals.update(extensions)

    def get_locals_as_dict(self) -> dict[str, Any]:
        """All locals, globals included."""
        return {**self._globals, **self._locals}

    @property
    def locals(self) -> _Locals:
        """All locals, as attributes: ``context.locals.event``."""
        return _Locals(self.get_locals_as_dict())

    def _push_locals(self) -> None:
        self._locals_stack.append(dict(self._locals))

    def _pop_locals(self) -> None:
        if not self._locals_stack:
            raise RuntimeError("locals stack unexpectedly empty")
        self._locals = self._locals_stack.pop()

    def perform_substitution(self, sub: Substitution) -> str:
        """The text of a substitution, here and now."""
        return sub.perform(self)


def _replace_environment(variables: Mapping[str, str]) -> None:
    for name in set(os.environ) - set(variables):
        del os.environ[name]
    os.environ.update(variables)
