"""Blocking for a response, without the deadlocks that lie in wait there."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING, Any

from .executor_exceptions import (
    ConditionReachedException,
    ExternalShutdownException,
    ShutdownException,
    TimeoutException,
)
from .service import Service

if TYPE_CHECKING:
    from .client import Client
    from .entity import Entity
    from .executors import Executor
    from .task import Future

__all__ = ["wait_for_response"]

#: After this time a wait that nobody seems to end is logged.
_PATIENCE_S = 1.0


def wait_for_response(future: Future, client: Client, timeout_sec: float | None) -> Any:
    """Block until ``future`` is done.

    Outside of the executor's thread this waits for whoever spins, and says so in the log when
    nobody does. In a callback of a single-threaded executor it serves the responses itself, since
    nobody else can.

    Raises:
        TimeoutError: The time was over before.
        RuntimeError: The service is in the executor that is blocked.
        ExternalShutdownException, ShutdownException: The context or the executor was shut down.
    """
    deadline = None if timeout_sec is None or timeout_sec < 0 else time.monotonic() + timeout_sec
    executor = client._serving_executor()
    if executor is not None and executor._spinning_thread == threading.get_ident():
        _serve_responses(executor, future, client, deadline)
    else:
        _wait_for_other_thread(future, client, executor, deadline)
    if not future.done():
        raise TimeoutError
    return future.result()


def _serve_responses(
    executor: Executor, future: Future, client: Client, deadline: float | None
) -> None:
    """In a callback of ``executor``: hand responses to their futures, and do nothing else, until ``future`` is done."""

    def is_hopeless() -> bool:
        return _is_served_by(client, executor._paused)

    future._add_waiter(executor.wake)
    outer, executor._response_awaited = executor._response_awaited, future
    patience: float | None = time.monotonic() + _PATIENCE_S
    try:
        while not future.done() and (deadline is None or time.monotonic() < deadline):
            if patience is not None and time.monotonic() >= patience:
                patience = None
                _warn_of_other_executor(client, executor)
            if is_hopeless():
                raise RuntimeError(
                    "The service is served by the executor that this call blocks: it would never answer"
                )
            try:
                executor._execute(
                    *executor._next(
                        _remaining_ns(deadline, patience), lambda: future.done() or is_hopeless()
                    )
                )
            except (TimeoutException, ConditionReachedException):
                continue
    finally:
        executor._response_awaited = outer
        executor._resume_paused()


def _remaining_ns(*moments: float | None) -> int | None:
    """Until the first of these moments; None when there is none."""
    known = [moment for moment in moments if moment is not None]
    return max(0, int((min(known) - time.monotonic()) * 1_000_000_000)) if known else None


def _is_served_by(client: Client, entities: set[Entity]) -> bool:
    name = client._wire.service
    return any(
        isinstance(entity, Service) and entity._wire.service == name for entity in list(entities)
    )


def _wait_for_other_thread(
    future: Future, client: Client, executor: Executor | None, deadline: float | None
) -> None:
    done = threading.Event()
    future._add_waiter(done.set)
    waits = [client._context._waits] + ([] if executor is None else [executor._blocked_waits])
    for wait in waits:
        wait.add(done)

    def is_over() -> bool:
        ended = not client._context.ok() or (executor is not None and executor._is_shutdown)
        return future.done() or ended or (deadline is not None and time.monotonic() >= deadline)

    try:
        patience: float | None = _PATIENCE_S
        while not is_over():
            done.clear()
            if not is_over() and not _wait(done, deadline, patience) and patience is not None:
                patience = None
                if not is_over():
                    _warn_of_long_wait(client, executor)
    finally:
        for wait in waits:
            wait.discard(done)
    if not future.done():
        _raise_if_ended(client, executor)


def _warn_of_long_wait(client: Client, executor: Executor | None) -> None:
    name = client._wire.service
    if executor is None or executor._spinning_thread is None:
        client._logger.warning(
            f"Waiting for a response of service '{name}', but nobody spins the node that calls it: "
            "spin it in another thread, or use call_async() and spin_until_future_complete()"
        )
    elif _is_served_by(client, executor._paused):
        client._logger.warning(
            f"Waiting for a response of service '{name}', which cannot run because its callback group is busy. If the callback that waits "
            "is in that group, it waits for ever: give the service a callback group of its own"
        )
    else:
        _warn_of_other_executor(client, executor)


def _warn_of_other_executor(client: Client, executor: Executor) -> None:
    """Another executor of this process has the request and cannot run the service."""
    if any(
        other is not executor and _is_served_by(client, other._paused)
        for other in client._context.executors()
    ):
        client._logger.warning(
            f"Waiting for a response of service '{client._wire.service}', which another executor "
            "of this process serves: all its threads, or the service's callback group, are busy. "
            "If they wait for a service of this executor, both wait for ever: use call_async() "
            "with await, or a MultiThreadedExecutor with more threads"
        )


def _wait(done: threading.Event, deadline: float | None, at_most: float | None) -> bool:
    remaining = None if deadline is None else max(0.0, deadline - time.monotonic())
    return done.wait(
        at_most if remaining is None else min(remaining, remaining if at_most is None else at_most)
    )


def _raise_if_ended(client: Client, executor: Executor | None) -> None:
    if not client._context.ok():
        raise ExternalShutdownException
    if executor is not None and executor._is_shutdown:
        raise ShutdownException
