"""Common helpers of the tests of asynchronous nodes."""

from __future__ import annotations

import asyncio
import sys

from rclpy.parameter import Parameter
from rclpy.time import Time

if sys.version_info >= (3, 11):
    from builtins import BaseExceptionGroup
else:
    from exceptiongroup import BaseExceptionGroup

IN_GROUP = "unhandled errors in a TaskGroup (1 sub-exception)"


async def until(predicate):
    """Let the loop run until something is true."""
    while not predicate():  # noqa: ASYNC110 - tests of events do not rely on events
        await asyncio.sleep(0)


def run(coroutine):
    """Run a coroutine; it fails after a minute."""
    return asyncio.run(asyncio.wait_for(coroutine, 60))


def tree(error):
    """Return class and text of an exception, and those that an exception group holds."""
    if isinstance(error, BaseExceptionGroup):
        return (type(error).__name__, str(error), *map(tree, error.exceptions))
    return type(error).__name__, str(error)


def in_groups(depth, *error):
    """Return the tree of an error within this many exception groups."""
    return ("ExceptionGroup", IN_GROUP, in_groups(depth - 1, *error)) if depth else error


async def failure(awaitable):
    """Await something that raises; return the tree of the exception."""
    try:
        value = await awaitable
    except BaseException as error:
        return tree(error)
    raise AssertionError(f"no exception, but {value!r}")


def failure_of(call, *arguments, **options):
    """Call something that raises; return class and text of the exception."""
    try:
        value = call(*arguments, **options)
    except Exception as error:
        return tree(error)
    raise AssertionError(f"no exception, but {value!r}")


class Simulation:
    """Simulated time of an asynchronous node, which the test moves."""

    def __init__(self, node, seconds=0.0) -> None:
        node.set_parameters([Parameter("use_sim_time", value=True)])
        self._clock = node.get_clock()
        self.set(seconds)

    def set(self, seconds: float) -> None:
        """Show a time."""
        self._clock.set_ros_time_override(Time(nanoseconds=round(seconds * 1e9)))
        self.seconds = seconds


async def turns(count=20):
    """Let the loop run everything that is ready."""
    for _ in range(count):
        await asyncio.sleep(0)
