"""Waits for starts, ends and output of the processes of a launch.

Each function has a form for coroutines and one for functions of pytest, which run on another thread
than the launch; that one ends with ``_sync``. All take the launch's context, the action that runs
the process, and the seconds to wait at most (None: no limit). Output can be read only of actions
with ``cached_output=True``.
"""

from __future__ import annotations

import asyncio
import contextlib
import functools
from collections.abc import Callable, Coroutine, Iterator
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from launch.event_handlers import OnProcessExit, OnProcessIO, OnProcessStart

if TYPE_CHECKING:
    from launch import LaunchContext
    from launch.actions import ExecuteProcess
    from launch.event_handler import BaseEventHandler

    Validate = Callable[[str], Any]

_Arguments = ParamSpec("_Arguments")
_Result = TypeVar("_Result")


@contextlib.contextmanager
def register_event_handler(
    context: LaunchContext, event_handler: BaseEventHandler
) -> Iterator[None]:
    """Register a handler for the time of a ``with`` block, on the thread of the launch."""
    context.register_event_handler(event_handler)
    try:
        yield
    finally:
        context.unregister_event_handler(event_handler)


async def wait_for_start(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    timeout: float | None = None,
) -> bool:
    """Wait until a process has started; returns whether it has."""
    changed = asyncio.Event()
    handler = OnProcessStart(
        target_action=execute_process_action, on_start=lambda *_: changed.set()
    )
    return await _wait(
        launch_context,
        (handler,),
        changed,
        lambda: execute_process_action.process_details is not None,
        timeout,
    )


async def wait_for_exit(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    timeout: float | None = None,
) -> bool:
    """Wait until a process has ended; returns whether it has."""
    changed = asyncio.Event()
    handler = OnProcessExit(target_action=execute_process_action, on_exit=lambda *_: changed.set())
    return await _wait(
        launch_context,
        (handler,),
        changed,
        lambda: execute_process_action.return_code is not None,
        timeout,
    )


async def wait_for_output(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Validate,
    timeout: float | None = None,
) -> bool:
    """Wait until a function accepts what a process has written to stdout.

    Args:
        launch_context: The context of the launch.
        execute_process_action: Runs the process.
        validate_output: Gets all of the text, and rejects it by returning False or by raising
            ``AssertionError``.
        timeout: Seconds to wait at most.

    Returns:
        True if the text was accepted in time.
    """
    read = execute_process_action.get_stdout
    return await _wait_for_text(
        launch_context, execute_process_action, read, validate_output, timeout
    )


async def wait_for_stderr(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Validate,
    timeout: float | None = None,
) -> bool:
    """Wait as :func:`wait_for_output` does, for stderr, where ROS nodes log."""
    read = execute_process_action.get_stderr
    return await _wait_for_text(
        launch_context, execute_process_action, read, validate_output, timeout
    )


async def assert_output(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Validate,
    timeout: float | None = None,
) -> None:
    """Wait as :func:`wait_for_output` does.

    Raises:
        AssertionError: The text was not accepted in time; the function's own error, if it has one.
    """
    if not await wait_for_output(launch_context, execute_process_action, validate_output, timeout):
        _refuse(validate_output, execute_process_action.get_stdout(), "stdout")


async def assert_stderr(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Validate,
    timeout: float | None = None,
) -> None:
    """Wait as :func:`assert_output` does, for stderr, where ROS nodes log."""
    if not await wait_for_stderr(launch_context, execute_process_action, validate_output, timeout):
        _refuse(validate_output, execute_process_action.get_stderr(), "stderr")


def _for_another_thread(
    function: Callable[_Arguments, Coroutine[Any, Any, _Result]],
) -> Callable[_Arguments, _Result]:
    """Return the form of a function that runs it on the loop of the launch."""

    @functools.wraps(function)
    def run(*args: _Arguments.args, **kwargs: _Arguments.kwargs) -> _Result:
        coroutine = function(*args, **kwargs)  # refuses wrong arguments
        context: Any = args[0] if args else kwargs["launch_context"]
        loop = context.asyncio_loop
        if loop is None:  # the launch has ended: the coroutine does not wait
            return asyncio.run(coroutine)
        return asyncio.run_coroutine_threadsafe(coroutine, loop).result()

    run.__name__ = run.__qualname__ = f"{function.__name__}_sync"
    run.__doc__ = f":func:`{function.__name__}` for another thread."
    return run


wait_for_start_sync = _for_another_thread(wait_for_start)
wait_for_exit_sync = _for_another_thread(wait_for_exit)
wait_for_output_sync = _for_another_thread(wait_for_output)
wait_for_stderr_sync = _for_another_thread(wait_for_stderr)
assert_output_sync = _for_another_thread(assert_output)
assert_stderr_sync = _for_another_thread(assert_stderr)


async def _wait_for_text(
    context: LaunchContext,
    action: ExecuteProcess,
    read: Callable[[], bytes],
    validate: Validate,
    timeout: float | None,
) -> bool:
    if not action.cached_output:
        raise ValueError(
            f"the output of {action.describe()} is not kept; give the action cached_output=True"
        )
    changed = asyncio.Event()

    def wake(*_: object) -> None:
        changed.set()

    handlers = (
        OnProcessIO(target_action=action, on_stdout=wake, on_stderr=wake),
        OnProcessExit(target_action=action, on_exit=wake),
    )
    return await _wait(
        context, handlers, changed, lambda: _accepts(validate, _text(read())), timeout
    )


async def _wait(
    context: LaunchContext,
    handlers: tuple[BaseEventHandler, ...],
    changed: asyncio.Event,
    fulfilled: Callable[[], bool],
    timeout: float | None,
) -> bool:
    """Wait until a condition is fulfilled, which is tested after each event."""
    if context.asyncio_loop is None:
        return fulfilled()

    async def until_fulfilled() -> None:
        while not fulfilled():
            # No event is lost, because the handlers run on this loop.
            changed.clear()
            await changed.wait()

    with contextlib.ExitStack() as registered:
        for handler in handlers:
            registered.enter_context(register_event_handler(context, handler))
        try:
            await asyncio.wait_for(until_fulfilled(), timeout)
        except asyncio.TimeoutError:
            # The last event may have come with the end of the time.
            return fulfilled()
        return True


def _accepts(validate: Validate, text: str) -> bool:
    try:
        # None is accepted: a function that asserts returns nothing.
        return validate(text) is not False
    except AssertionError:
        return False


def _refuse(validate: Validate, written: bytes, stream: str) -> None:
    text = _text(written)
    assert validate(text) is not False, f"what was written to {stream} was not accepted: {text!r}"


def _text(written: bytes) -> str:
    return written.decode(errors="replace")
