"""Tests that run while the loop of their launch runs."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    import asyncio

_END = object()


def wrap_func(
    func: Callable[..., Any],
    event_loop: asyncio.AbstractEventLoop,
    before_test: Callable[[], Any] | None,
) -> Callable[..., None]:
    """Return a test that runs a function in another thread while the loop of its launch runs.

    Args:
        func: The function.
        event_loop: The loop.
        before_test: Called before the function, if it is given.
    """

    @functools.wraps(func)
    def test(**kwargs: Any) -> None:
        if before_test is not None:
            before_test()
        bound = functools.partial(func, **kwargs)
        run_until_complete(event_loop, event_loop.run_in_executor(None, bound))

    return test


def wrap_coroutine(
    func: Callable[..., Any],
    event_loop: asyncio.AbstractEventLoop,
    before_test: Callable[[], Any] | None,
) -> Callable[..., None]:
    """Return a test that runs a coroutine function on the loop of its launch; see `wrap_func`."""

    @functools.wraps(func)
    def test(**kwargs: Any) -> None:
        if before_test is not None:
            before_test()
        run_until_complete(event_loop, func(**kwargs))

    return test


def wrap_generator(
    func: Callable[..., Any],
    event_loop: asyncio.AbstractEventLoop,
    on_shutdown: Callable[[], Any],
) -> tuple[Callable[..., None], Callable[[], None]]:
    """Return two tests: the part of a generator function up to its ``yield``, and the rest.

    Args:
        func: The generator function, or an asynchronous one.
        event_loop: The loop of the launch, which runs meanwhile.
        on_shutdown: Called before the rest.
    """
    steps: Any = None

    @functools.wraps(func)
    def test(**kwargs: Any) -> None:
        nonlocal steps
        steps = func(**kwargs)
        _require(_step(event_loop, steps), f"{func.__name__} did not yield")

    @functools.wraps(func)
    def shutdown_test() -> None:
        on_shutdown()
        if steps is None or not _is_suspended(steps):
            pytest.skip(f"{func.__name__} did not reach its yield")
        _require(not _step(event_loop, steps), f"{func.__name__} has more than one yield")

    return test, shutdown_test


def wrap_generator_fscope(
    func: Callable[..., Any],
    event_loop: asyncio.AbstractEventLoop,
    on_shutdown: Callable[[], Any],
) -> Callable[..., None]:
    """Return one test that runs both parts of `wrap_generator`."""
    begin, end = wrap_generator(func, event_loop, on_shutdown)

    @functools.wraps(func)
    def test(**kwargs: Any) -> None:
        begin(**kwargs)
        end()

    return test


# The steps of a generator are run by its kind.
wrap_asyncgen = wrap_generator
wrap_asyncgen_fscope = wrap_generator_fscope


def _step(loop: asyncio.AbstractEventLoop, steps: Any) -> bool:
    """Run a generator up to its next ``yield``; returns whether there is one."""
    if inspect.isasyncgen(steps):
        return bool(run_until_complete(loop, anext(steps, _END)) is not _END)
    # In another thread, so that the launch keeps running while the test blocks.
    step = loop.run_in_executor(None, next, steps, _END)
    return bool(run_until_complete(loop, step) is not _END)


def _is_suspended(steps: Any) -> bool:
    # A generator that has ended has no frame any more.
    frame = steps.ag_frame if inspect.isasyncgen(steps) else steps.gi_frame
    return frame is not None


def _require(fulfilled: bool, otherwise: str) -> None:
    if not fulfilled:
        pytest.fail(otherwise, pytrace=False)


def run_until_complete(loop: asyncio.AbstractEventLoop, future_like: Awaitable[Any]) -> Any:
    """Run a loop until something has completed; returns its result."""
    return loop.run_until_complete(_awaited(future_like))


async def _awaited(future_like: Awaitable[Any]) -> Any:
    # A coroutine, because `anext` returns only an awaitable.
    return await future_like
