"""The context that the entities of a launch get."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, MutableMapping
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from launch import logging
from launch._kernel.run import Run

if TYPE_CHECKING:
    import asyncio

    from launch._kernel.protocols import EventHandling, Performable
    from launch.event import Event

V = TypeVar("V")


class _Locals:
    """Read access to the locals as attributes."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        self._values = values

    def __getattr__(self, name: str) -> Any:
        """Return the local of that name."""
        if name not in self._values:
            raise AttributeError(
                f"context.locals has no attribute '{name}', "
                f"available attributes: {sorted(self._values)}"
            )
        return self._values[name]


class Scopes(Generic[V]):
    """A stack of copies of one mapping, for changes that end with a scope.

    Args:
        values: The mapping, which is changed in place.
        kind: Names it in errors.
    """

    def __init__(self, values: MutableMapping[str, V], kind: str) -> None:
        self._values = values
        self._kind = kind
        self._copies: list[dict[str, V]] = []

    @property
    def depth(self) -> int:
        """The number of scopes that have begun and not ended."""
        return len(self._copies)

    def push(self) -> None:
        """Remember the values."""
        self._copies.append(dict(self._values))

    def pop(self) -> None:
        """Put the values back that were remembered last.

        Raises:
            RuntimeError: No scope was pushed.
        """
        if not self._copies:
            raise RuntimeError(f"{self._kind} stack unexpectedly empty")
        self.replace(self._copies.pop())

    def replace(self, values: Mapping[str, V]) -> None:
        """Make the mapping equal to ``values``."""
        # In place, because `os.environ` cannot be replaced.
        for name in set(self._values) - set(values):
            del self._values[name]
        self._values.update(values)


class LaunchContext:
    """Events, launch configurations, environment and locals of one launch.

    All methods are for the thread of its event loop, except for :meth:`emit_event_sync` and
    :meth:`emit_event`.

    Args:
        argv: Arguments of the launch.
        noninteractive: Whether no user watches it at a terminal.
        run: The state of the launch; a launch that is only looked at gets its own.
    """

    def __init__(
        self,
        *,
        argv: Iterable[str] | None = None,
        noninteractive: bool = False,
        run: Run[LaunchContext] | None = None,
    ) -> None:
        self._argv = list(argv or ())
        self._noninteractive = noninteractive
        self._run: Run[LaunchContext] = Run() if run is None else run
        self._launch_configurations: dict[str, str] = {}
        self._environment_at_start = dict(os.environ)
        self._globals: dict[str, Any] = {}
        self._locals: dict[str, Any] = {}
        #: Begin and end scopes of the launch configurations.
        self.configuration_scopes = Scopes(self._launch_configurations, "launch configurations")
        #: Begin and end scopes of the environment variables.
        self.environment_scopes = Scopes(os.environ, "environment")
        #: Begin and end scopes of the locals.
        self.local_scopes = Scopes(self._locals, "locals")
        self._logger = logging.get_logger("launch.launch_context")

    @property
    def argv(self) -> list[str]:
        """Arguments of the launch."""
        return self._argv

    @property
    def noninteractive(self) -> bool:
        """True if no user watches the launch at a terminal."""
        return self._noninteractive

    @property
    def is_shutdown(self) -> bool:
        """True if the launch is ending."""
        return self._run.is_shutdown

    @property
    def asyncio_loop(self) -> asyncio.AbstractEventLoop | None:
        """The event loop that the launch runs on, or None before it runs."""
        return self._run.loop

    # events

    def register_event_handler(
        self, event_handler: EventHandling[LaunchContext], append: bool = False
    ) -> None:
        """Add a handler: before all others, or after them."""
        self._run.register(event_handler, last=append)

    def unregister_event_handler(self, event_handler: EventHandling[LaunchContext]) -> None:
        """Remove a handler.

        Raises:
            ValueError: The handler is not registered.
        """
        self._run.unregister(event_handler)

    def would_handle_event(self, event: Event) -> bool:
        """Return True if a handler is registered for such an event."""
        return any(handler.matches(event) for handler in self._run.handlers())

    def emit_event_sync(self, event: Event) -> None:
        """Queue an event; its handlers run later on the loop. Safe from any thread."""
        self._logger.debug("emitting event synchronously: '%s'", event.name)
        self._run.emit(event)

    async def emit_event(self, event: Event) -> None:
        """Queue an event; its handlers run later on the loop."""
        self._logger.debug("emitting event: '%s'", event.name)
        self._run.emit(event)

    # work of the launch

    def add_completion_future(self, completion_future: asyncio.Future[Any]) -> None:
        """Keep the launch running until the future is done."""
        self._run.keep_running_for(completion_future)

    def marked_environment(self, environment: Mapping[str, str]) -> dict[str, str]:
        """Return the environment for a child; its mark lets the launch end all descendants."""
        return self._run.marked(environment)

    # launch configurations, environment, locals

    @property
    def launch_configurations(self) -> dict[str, str]:
        """The launch configurations; change them through actions or here."""
        return self._launch_configurations

    @property
    def environment(self) -> MutableMapping[str, str]:
        """The environment variables of this process, which its children inherit."""
        return os.environ

    def reset_environment(self) -> None:
        """Put the environment variables back that this context began with."""
        self.environment_scopes.replace(self._environment_at_start)

    def extend_globals(self, extensions: Mapping[str, Any]) -> None:
        """Add locals that are there during all visits."""
        self._globals.update(extensions)

    def extend_locals(self, extensions: Mapping[str, Any]) -> None:
        """Add locals for the visits that belong to the current event."""
        self._locals.update(extensions)

    def get_locals_as_dict(self) -> dict[str, Any]:
        """Return all locals, globals included."""
        return {**self._globals, **self._locals}

    @property
    def locals(self) -> _Locals:
        """All locals, as attributes: ``context.locals.event``."""
        return _Locals(self.get_locals_as_dict())

    def perform_substitution(self, substitution: Performable[LaunchContext]) -> str:
        """Return the text of a substitution, here and now."""
        return substitution.perform(self)
