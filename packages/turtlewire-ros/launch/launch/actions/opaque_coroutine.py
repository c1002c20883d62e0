"""Runs a coroutine."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Coroutine, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.event_handlers import OnShutdown

if TYPE_CHECKING:
    import asyncio

    from launch.launch_context import LaunchContext


class OpaqueCoroutine(Action):
    """Runs a coroutine on the loop of the launch; it is cancelled when the launch ends.

    Args:
        coroutine: The coroutine function.
        args: Positional arguments.
        kwargs: Keyword arguments.
        ignore_context: Whether to leave out the context, which is otherwise its first argument.
        **left_over_kwargs: See :class:`Action`.
    """

    def __init__(
        self,
        *,
        coroutine: Callable[..., Coroutine[Any, Any, None]],
        args: Iterable[Any] | None = None,
        kwargs: Mapping[str, Any] | None = None,
        ignore_context: bool = False,
        **left_over_kwargs: Any,
    ) -> None:
        super().__init__(**left_over_kwargs)
        if not inspect.iscoroutinefunction(coroutine):
            raise TypeError(
                "OpaqueCoroutine expected a coroutine function for 'coroutine', "
                f"got '{type(coroutine)}' instead"
            )
        self._coroutine = coroutine
        self._args = tuple(args or ())
        self._kwargs = dict(kwargs or {})
        self._ignore_context = ignore_context
        self._future: asyncio.Task[None] | None = None

    def execute(self, context: LaunchContext) -> None:
        assert context.asyncio_loop is not None
        args = self._args if self._ignore_context else (context, *self._args)
        task = context.asyncio_loop.create_task(self._coroutine(*args, **self._kwargs))

        def cancel(*_: object) -> None:
            task.cancel()

        end = OnShutdown(on_shutdown=cancel)
        context.register_event_handler(end)
        task.add_done_callback(lambda _: context.unregister_event_handler(end))
        self._future = task

    def get_asyncio_future(self) -> asyncio.Task[None] | None:
        """Done when it has returned."""
        return self._future
