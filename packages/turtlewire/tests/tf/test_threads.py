"""Many threads at once, on one buffer and on one each: for free-threaded Pythons, and for others.

The pose of every link is a function of the time alone, so an answer made of torn data is wrong.
"""

from __future__ import annotations

import contextlib
import gc
import itertools
import math
import sys
import sysconfig
import threading
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from tests.programs import run_python

from turtlewire import errors, msg

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

TICK = 1_953_125  # ns; 1/512 s, which doubles hold exactly
SECOND = 512 * TICK
CHAIN = ("f0", "f1", "f2", "f3")
LINKS = tuple(pairwise(CHAIN))
LONG_NS = 60 * SECOND  # longer than any wait takes


@pytest.fixture(autouse=True)
def many_changes_of_threads() -> Iterator[None]:
    usual = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    yield
    sys.setswitchinterval(usual)


@pytest.fixture
def rounds(core: Any) -> int:
    return 100 if core.__name__ == "turtlewire._native" else 15


def stamp(number: int) -> int:
    return SECOND + number * TICK


def along_x(seconds: float) -> tuple[float, float, float]:
    return (seconds, 0.0, 0.0)


def check_sum(x: float, time_ns: int) -> None:
    assert abs(x - len(LINKS) * time_ns / SECOND) < 1e-9


def tf_message(time_ns: int) -> bytes:
    stamped: Any = msg.get_message("geometry_msgs/msg/TransformStamped")
    message: Any = msg.get_message("tf2_msgs/msg/TFMessage")()
    for parent, child in LINKS:
        transform = stamped(child_frame_id=child)
        transform.header.frame_id = parent
        transform.header.stamp.sec, transform.header.stamp.nanosec = divmod(time_ns, SECOND)
        transform.transform.translation.x = time_ns / SECOND
        transform.transform.rotation.w = 1.0
        message.transforms.append(transform)
    return msg.serialize(message)


class Roles:
    """What threads do with a buffer; each method is one round of one of them."""

    def __init__(self, core: Any, buffer: Any) -> None:
        self.core = core
        self.buffer = buffer
        self.calls = itertools.count()
        self.messages = None
        if core.__name__ == "turtlewire._native":
            example = msg.get_message("geometry_msgs/msg/TransformStamped")()
            self.messages = core.MessageLookup(buffer, example)
        self.time = SimpleNamespace(sec=1, nanosec=2 * TICK)

    def set_transforms_one_by_one(self, i: int) -> None:
        for time_ns in range(stamp(i), stamp(i + 1), TICK // 5):
            for parent, child in LINKS:
                self.buffer.set_transform(parent, child, time_ns, along_x(time_ns / SECOND))
        self.buffer.set_static_transform("f0", f"signal{i}", along_x(i))

    def set_rows(self, i: int) -> None:
        stamps = stamp(i) + TICK * np.arange(8)
        poses = np.zeros((8, 7))
        poses[:, 0], poses[:, 6] = stamps / SECOND, 1.0
        for parent, child in LINKS:
            self.buffer.set_transforms(parent, child, stamps, poses)

    def add_messages(self, i: int) -> None:
        assert self.buffer.add_tf_message(tf_message(stamp(i))) <= len(LINKS)

    def look_up(self, i: int) -> None:
        found = self.buffer.lookup_transform("f0", "f3")
        check_sum(found.x, found.stamp_ns)
        assert self.buffer.can_transform("f0", "f3", found.stamp_ns) in (False, True)
        for time_ns in range(stamp(i), stamp(i + 1), TICK // 10):
            check_sum(self.buffer.lookup_transform("f0", "f3", time_ns).x, time_ns)

    def look_up_by_new_names(self, i: int) -> None:
        for time_ns in range(stamp(i), stamp(i + 1), TICK // 5):
            ends = (f"f{i * 0}", f"f{i * 0 + 3}")  # other objects each time
            found = self.buffer.lookup_transform(*ends, time_ns, extrapolate_ns=SECOND)
            assert (found.target_frame, found.source_frame) == ends
            check_sum(found.x, time_ns)

    def look_up_messages(self, i: int) -> None:
        if self.messages is not None:
            found = self.messages.lookup("f0", "f3", self.time)
            assert (found.header.frame_id, found.child_frame_id) == ("f0", "f3")
            check_sum(found.transform.translation.x, SECOND + 2 * TICK)

    def look_up_many(self, i: int) -> None:
        stamps = stamp(i) + TICK // 4 * np.arange(70)
        poses = self.buffer.lookup_transforms("f0", "f3", stamps, errors="nan")
        for x, time_ns in zip(poses[:, 0].tolist(), stamps.tolist(), strict=True):
            if not math.isnan(x):
                check_sum(x, time_ns)
        self.buffer.transform_points("f0", "f3", np.zeros((70, 3)), stamps, errors="nan")
        self.buffer.lookup_velocity("f0", "f3", stamps, errors="nan")
        self.buffer.lookup_all("f0")

    def forget(self, i: int) -> None:
        if i % 10 == 5:
            self.buffer.clear()
        self.buffer.remove_frame(CHAIN[i % 4])
        assert "f0" not in self.buffer.remove_stale(stamp(i - 60))

    def inspect(self, i: int) -> None:
        assert all(name.startswith(("f", "signal", "heard")) for name in self.buffer.frames())
        assert self.buffer.to_yaml()
        # The target is checked first: another thread may just have removed f0.
        assert self.buffer.explain("nowhere", "f0").frame == "nowhere"
        self.buffer.time_range("f0", "f3")

    def hear_of_changes(self, i: int) -> None:
        remove = self.buffer.on_change(self.count)
        self.buffer.set_static_transform("f0", "heard", along_x(i))
        remove()

    def count(self) -> None:
        next(self.calls)

    def wait(self, i: int) -> None:
        found = self.buffer.lookup_transform("f0", f"signal{i}", timeout_ns=LONG_NS)
        assert found.x == i

    def make_and_drop(self, i: int) -> None:
        """Drop buffers that only their errors, listeners and message lookups still refer to."""
        buffer = self.core.Buffer()
        if self.messages is not None:
            self.core.MessageLookup(buffer, msg.get_message("geometry_msgs/msg/TransformStamped")())
        buffer.on_change(lambda: buffer)  # a cycle
        buffer.set_transform("a", "b", 1, (0, 0, 0))
        with pytest.raises(errors.LookupException):
            buffer.lookup_transform("a", "c")
        if i % 50 == 0:
            gc.collect()


def run(roles: list[Callable[[int], None]], rounds: int) -> None:
    """Run each function in its own thread."""
    start = threading.Barrier(len(roles))

    def play(role: Callable[[int], None]) -> None:
        start.wait(60)
        for i in range(rounds):
            role(i)

    with ThreadPoolExecutor(len(roles)) as threads:
        for _ in threads.map(play, roles):
            pass


def tolerant(role: Callable[[int], None]) -> Callable[[int], None]:
    """Return a role that may ask what has no answer at the moment."""

    def play(i: int) -> None:
        with contextlib.suppress(errors.TransformException):
            role(i)

    return play


def test_threads_share_a_buffer(core: Any, rounds: int) -> None:
    buffer = core.Buffer()
    roles = Roles(core, buffer)
    roles.set_rows(0)
    run(
        [
            roles.set_transforms_one_by_one,
            roles.set_rows,
            roles.add_messages,
            tolerant(roles.look_up),
            tolerant(roles.look_up),
            tolerant(roles.look_up_by_new_names),
            tolerant(roles.look_up_messages),
            tolerant(roles.look_up_many),
            roles.forget,
            tolerant(roles.inspect),
            roles.hear_of_changes,
            roles.wait,
            roles.make_and_drop,
        ],
        rounds,
    )
    assert next(roles.calls) >= rounds
    roles.set_rows(rounds)
    check_sum(buffer.lookup_transform("f0", "f3").x, stamp(rounds + 7))


def test_lookups_at_the_same_time_all_have_answers(core: Any, rounds: int) -> None:
    """Nothing is forgotten here, so that every lookup must succeed while data comes in."""
    roles = Roles(core, core.Buffer())
    for i in range(0, rounds + 40, 8):
        roles.set_rows(i)

    def look_up(i: int) -> None:
        roles.look_up(i)
        roles.look_up_by_new_names(i)
        roles.look_up_messages(i)
        roles.look_up_many(i)

    run([look_up, look_up, roles.set_transforms_one_by_one], rounds)


def test_each_thread_has_its_own_buffer(core: Any, rounds: int) -> None:
    def work(own: Roles, i: int) -> None:
        own.set_rows(i)
        own.look_up(i)
        own.look_up_by_new_names(i)
        own.look_up_messages(0)
        own.look_up_many(i)
        own.hear_of_changes(i)

    def named(own: Roles) -> Callable[[int], None]:
        return lambda i: work(own, i)

    run([named(Roles(core, core.Buffer())) for _ in range(4)], rounds // 4)


def test_the_core_leaves_the_gil_off() -> None:
    """A module that does not declare that it works without a GIL turns it on when imported."""
    program = """
import sys
import turtlewire, turtlewire.tf

buffer = turtlewire.Buffer()
buffer.set_transform("map", "robot", 1, (0, 0, 0))
buffer.lookup_transforms("map", "robot", [1])
print(getattr(sys, "_is_gil_enabled", lambda: True)())
"""
    without_gil = bool(sysconfig.get_config_var("Py_GIL_DISABLED"))
    assert run_python(program).stdout.strip() == str(not without_gil)
