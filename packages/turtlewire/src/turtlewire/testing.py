"""Helpers for tests of programs that use transforms: an isolated domain, buffers, waiting.

In ``conftest.py``, for the whole run::

    @pytest.fixture(scope="session", autouse=True)
    def domain():
        with turtlewire.testing.isolated_domain() as number:
            yield number

and in a test::

    buffer = turtlewire.testing.filled_buffer([("world", "robot", (1.0, 0.0, 0.0))])
    assert my_program.place_of("robot", buffer) == (1.0, 0.0, 0.0)
"""

from __future__ import annotations

import contextlib
import os
import socket
import tempfile
import threading
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from typing import Protocol

    from turtlewire.tf.buffer import Buffer
    from turtlewire.tf.datetimes import Span

    Link = (
        tuple[str, str]
        | tuple[str, str, tuple[float, float, float]]
        | tuple[str, str, tuple[float, float, float], tuple[float, float, float, float]]
    )

    class Changing(Protocol):
        """Calls back after changes, as :class:`turtlewire.Buffer` and a context's graph do."""

        def on_change(self, call: Callable[[], None], /) -> Callable[[], None]:
            """Call ``listener`` after each change; returns a function that ends it."""
            ...


__all__ = ["filled_buffer", "isolated_domain", "reserved_domain", "wait_for"]

_FIRST_PORT, _PORTS_OF_DOMAIN = 7410, 250
_LAST_DOMAIN = 101  # systems assign the ports of those above to any program


@contextlib.contextmanager
def reserved_domain() -> Iterator[int]:
    """A ROS domain in which no process of this computer is.

    Within the ``with`` block no other caller of this function, in any process, gets the same
    domain.

    Raises:
        RuntimeError: All domains from 1 to 101 are in use.
    """
    for offset in range(_LAST_DOMAIN):
        domain = 1 + (os.getpid() + offset) % _LAST_DOMAIN
        port = _FIRST_PORT + _PORTS_OF_DOMAIN * domain
        # A TCP port that DDS does not use stands for the domain.
        with socket.socket() as reservation:
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
                try:
                    probe.bind(("", port))
                    reservation.bind(("127.0.0.1", port))
                except OSError:
                    continue
            yield domain
            return
    raise RuntimeError(f"all ROS domains from 1 to {_LAST_DOMAIN} are in use on this computer")


@contextlib.contextmanager
def isolated_domain() -> Iterator[int]:
    """Give this process and its children their own ROS domain, on this computer only.

    Sets ``ROS_DOMAIN_ID``, ``ROS_AUTOMATIC_DISCOVERY_RANGE`` and ``ROS_LOG_DIR`` (a temporary
    folder) in the environment, removes other variables that choose peers or the middleware, and
    restores all of them at the end. Contexts that are open already stay where they are.
    """
    chosen = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    removed = ("RMW_IMPLEMENTATION", "ROS_LOCALHOST_ONLY", "ROS_STATIC_PEERS")
    with (
        reserved_domain() as domain,
        tempfile.TemporaryDirectory(prefix="turtlewire-test-", ignore_cleanup_errors=True) as log,
    ):
        chosen |= {"ROS_DOMAIN_ID": str(domain), "ROS_LOG_DIR": log}
        before = {name: os.environ.get(name) for name in (*chosen, *removed)}
        os.environ.update(chosen)
        for name in removed:
            os.environ.pop(name, None)
        try:
            yield domain
        finally:
            for name, value in before.items():
                if value is None:
                    os.environ.pop(name, None)
                else:
                    os.environ[name] = value


def filled_buffer(links: Iterable[Link], *, stamp_ns: int | None = None) -> Buffer:
    """Return a buffer with the given links.

    Args:
        links: For each link the parent frame, the child frame, and where the child is in the
            parent: its translation [m], zero unless given, and its rotation as xyzw, none unless
            given.
        stamp_ns: The time of the transforms; None makes them static.

    Raises:
        InvalidTransformError: The buffer refuses a link.
    """
    from turtlewire.tf.buffer import Buffer

    buffer = Buffer()
    for parent, child, *pose in links:
        translation = pose[0] if pose else (0.0, 0.0, 0.0)
        rotation = pose[1] if len(pose) > 1 else (0.0, 0.0, 0.0, 1.0)
        if stamp_ns is None:
            buffer.set_static_transform(parent, child, translation, rotation)
        else:
            buffer.set_transform(parent, child, stamp_ns, translation, rotation)
    return buffer


def wait_for(
    predicate: Callable[[], bool], *sources: Changing, timeout_ns: Span = 60_000_000_000
) -> None:
    """Block until a predicate is true; it is tested at once and after each change of a source.

    Args:
        predicate: Called on this thread, without locks held.
        sources: What the predicate depends on: buffers (``turtlewire.Buffer``).
        timeout_ns: A limit in nanoseconds or as ``timedelta64``, generous because test machines
            are busy.

    Raises:
        TimeoutError: The predicate is still false after ``timeout_ns``.
    """
    import time

    from turtlewire.tf.datetimes import as_nanoseconds

    timeout_s = as_nanoseconds(timeout_ns, "timeout_ns") / 1e9
    changed = threading.Event()
    end = time.monotonic() + timeout_s
    with contextlib.ExitStack() as stack:
        for source in sources:
            stack.callback(source.on_change(changed.set))
        while not predicate():
            if not changed.wait(max(0.0, end - time.monotonic())):
                raise TimeoutError(f"the condition was not met within {timeout_s:g} s")
            changed.clear()
