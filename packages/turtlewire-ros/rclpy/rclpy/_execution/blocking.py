"""Waits for responses; avoids or reports deadlocks of such waits, and of ``await``."""

from __future__ import annotations

import threading
import time
from collections.abc import Collection, Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

from rclpy.service import Service
from turtlewire.wake_up import WakeUp

from .exceptions import (
    ConditionReachedException,
    ExternalShutdownException,
    ShutdownException,
    TimeoutException,
)

if TYPE_CHECKING:
    from rclpy.context import Context
    from rclpy.impl.rcutils_logger import RcutilsLogger
    from rclpy.task import Future

    from .entity import Entity, EntityHost

#: Time after which a wait that probably never ends is logged.
_PATIENCE_S = 1.0


class BlockingCall(NamedTuple):
    """A service call that blocks its thread until the response arrives.

    Attributes:
        service: Full name of the service.
        context: The client's context, whose shutdown ends the wait.
        logger: Where warnings go.
        host: Of the executor that serves the client; None if no executor does.
    """

    service: str
    context: Context
    logger: RcutilsLogger
    host: EntityHost | None


def limit_ns(timeout_sec: float | None) -> int | None:
    """Convert the timeout of a call that blocks; None for no limit.

    As in ROS 2, the time of a negative timeout is over.
    """
    if timeout_sec is None or timeout_sec >= threading.TIMEOUT_MAX:
        return None
    return max(0, int(timeout_sec * 1_000_000_000))


def wait_for_response(future: Future[Any], call: BlockingCall, timeout_sec: float | None) -> None:
    """Block until ``future`` is done, or the timeout has passed.

    Outside of the executor's thread this waits for the thread that spins, and warns if there is
    none. In a callback of a single-threaded executor it serves the responses itself.

    Raises:
        RuntimeError: The service is in the executor that is blocked.
        ExternalShutdownException, ShutdownException: The context or the executor was shut down.
    """
    timeout_ns = limit_ns(timeout_sec)
    deadline = None if timeout_ns is None else time.monotonic() + timeout_ns / 1e9
    host = call.host
    if host is not None and host.is_spun_by_this_thread():
        _serve_responses(host, future, call, deadline)
    else:
        _wait_for_other_thread(future, call, deadline)


def _serve_responses(
    host: EntityHost, future: Future[Any], call: BlockingCall, deadline: float | None
) -> None:
    """Hand out responses, and run nothing else, until ``future`` is done.

    For a callback of the executor's own thread.
    """
    patience: float | None = time.monotonic() + _PATIENCE_S
    # Another thread may finish the future, for example by cancelling it.
    with future._waking(host.wake), host.serving_responses(future):
        while not future.done() and (deadline is None or time.monotonic() < deadline):
            if patience is not None and time.monotonic() >= patience:
                patience = None
                _warn_of_other_executor(call)
            # The request has arrived, and only this thread could answer it.
            if host.holds_up(call.service):
                raise RuntimeError(
                    "The service is served by the executor that this call blocks: "
                    "it would never answer"
                )
            try:
                ready = host.next(
                    _remaining_ns(deadline, patience),
                    # Both can become true during the wait although no callback is ready.
                    lambda: future.done() or host.holds_up(call.service),
                )
            except (TimeoutException, ConditionReachedException):
                continue
            host.execute(*ready)


def _remaining_ns(*moments: float | None) -> int | None:
    """Return the nanoseconds until the first of these moments; None for no limit."""
    known = [moment for moment in moments if moment is not None]
    return max(0, int((min(known) - time.monotonic()) * 1_000_000_000)) if known else None


def _wait_for_other_thread(future: Future[Any], call: BlockingCall, deadline: float | None) -> None:
    done = WakeUp()
    # A shutdown of the context or of the executor sets `done` as well.
    waits = [call.context.waits] + ([] if call.host is None else [call.host.blocked])
    for wait in waits:
        wait.add(done)

    def is_over() -> bool:
        ended = not call.context.ok() or _is_shutdown(call.host)
        return future.done() or ended or (deadline is not None and time.monotonic() >= deadline)

    try:
        patience: float | None = _PATIENCE_S
        with future._waking(done.set):
            while not is_over():
                if not _wait(done, deadline, patience) and patience is not None:
                    patience = None
                    # The wait may have ended at its deadline, or for a shutdown.
                    if not is_over():
                        _warn_of_long_wait(call)
    finally:
        for wait in waits:
            wait.discard(done)
    if not future.done():
        _raise_if_ended(call)


def _is_shutdown(host: EntityHost | None) -> bool:
    return host is not None and host.is_shutdown


def _warn_of_long_wait(call: BlockingCall) -> None:
    if call.host is None or not call.host.is_spun():
        call.logger.warning(
            f"Waiting for a response of service '{call.service}', but no executor spins the "
            "calling node: spin it in another thread, or use call_async() and "
            "spin_until_future_complete()"
        )
    elif call.host.holds_up(call.service):
        call.logger.warning(
            f"Waiting for a response of service '{call.service}', which cannot run because its "
            "callback group is busy. If the waiting callback is in that group, this is a "
            "deadlock: give the service its own callback group"
        )
    else:
        _warn_of_other_executor(call)


def _warn_of_other_executor(call: BlockingCall) -> None:
    """Warn if another executor of this process has the request and cannot run the service."""
    others = [host for host in list(call.context._schedulers) if host is not call.host]
    if any(host.holds_up(call.service) for host in others):
        call.logger.warning(
            f"Waiting for a response of service '{call.service}', which another executor "
            "of this process serves: all its threads, or the service's callback group, are busy. "
            "If they wait for a service of this executor, this is a deadlock: use call_async() "
            "with await, or a MultiThreadedExecutor with more threads"
        )


def _wait(done: WakeUp, deadline: float | None, at_most: float | None) -> bool:
    remaining = None if deadline is None else max(0.0, deadline - time.monotonic())
    return done.wait(
        at_most if remaining is None else min(remaining, remaining if at_most is None else at_most)
    )


def _raise_if_ended(call: BlockingCall) -> None:
    if not call.context.ok():
        raise ExternalShutdownException
    if _is_shutdown(call.host):
        raise ShutdownException


class SelfWaits:
    """Services held up by an async callback that may be waiting for them; warns after a second.

    Attributes:
        due: The services to warn about, and when.
    """

    def __init__(self) -> None:
        self.due: dict[Entity, tuple[Service, int]] = {}

    def held_up(
        self, entity: Entity, suspended: Collection[Entity], served: Iterable[Entity]
    ) -> None:
        """Note an entity that has work which its group does not let it do.

        It counts when it is a service, a suspended callback holds its group, and a client waits for
        its response.

        Args:
            entity: What is held up.
            suspended: Entities whose async callbacks await something.
            served: All entities of the executor.
        """
        if isinstance(entity, Service) and any(
            other.callback_group is entity.callback_group for other in suspended
        ):
            service = entity._wire.service  # `service_name` raises when another thread destroys it
            if any(other._awaits(service) for other in list(served)):
                self.due[entity] = (entity, time.monotonic_ns() + int(_PATIENCE_S * 1e9))

    def goes_on(self, entity: Entity) -> None:
        """Stop watching an entity that may run again or was released."""
        self.due.pop(entity, None)

    def bounded(self, timeout_ns: int | None) -> int | None:
        """Shorten a wait so that :meth:`warn` can be called in time."""
        moments = [due for _, due in list(self.due.values())]
        if not moments:
            return timeout_ns
        left = max(0, min(moments) - time.monotonic_ns())
        return left if timeout_ns is None else min(left, timeout_ns)

    def warn(self) -> None:
        """Warn once of services that have been held up for too long."""
        for service, due in list(self.due.values()):
            if time.monotonic_ns() >= due:
                self.due.pop(service, None)
                service._warn_of_self_wait()
