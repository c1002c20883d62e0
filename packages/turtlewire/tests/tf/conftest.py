"""Tests that take `buffer` or `core` run on both cores.

`make_world` makes random trees with questions.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import pytest
from tests.needs import COMPILED_CORE

from turtlewire import msg

if TYPE_CHECKING:
    import turtlewire

TICK = 1_953_125  # ns; 1/512 s, which doubles hold exactly


def cores() -> list[Any]:
    from turtlewire.tf import plain

    found: list[Any] = [pytest.param(plain, id="python")]
    try:
        from turtlewire import _native
    except ImportError:
        found.append(pytest.param(None, id="native", marks=pytest.mark.skip(reason=COMPILED_CORE)))
    else:
        found.append(pytest.param(_native, id="native"))
    return found


@pytest.fixture(params=cores(), scope="session")
def core(request: pytest.FixtureRequest) -> Any:
    """A module with `Buffer` and `Transform`."""
    return request.param


@pytest.fixture
def buffer(core: Any) -> turtlewire.Buffer:
    made: turtlewire.Buffer = core.Buffer()
    return made


class World:
    """A tree that grows and moves, and is asked in between.

    Operations: ("set", parent, child, stamp, pose, static), ("clear",), ("lookup", target, source,
    stamp), ("full", target, stamp, source, stamp, fixed), ("common", target, source).

    Args:
        seed: Decides everything.
        wild: Whether frames change their kind, one stamp gets several values, gaps exceed the
            cache, and loops close.
    """

    def __init__(self, seed: int, *, wild: bool) -> None:
        self.random = random.Random(seed)
        self.wild = wild
        self.names = [f"f{i}" for i in range(self.random.choice([1, 2, 3, 5, 8, 20, 60]))]
        self.static = {name: self.random.random() < 0.3 for name in self.names}
        self.parents = {
            name: self.names[self.random.randrange(i)] for i, name in enumerate(self.names) if i
        }
        self.now = 512 * self.random.randrange(1, 100)
        self.sent: dict[tuple[str, int], tuple[Any, ...]] = {}
        self.operations = list(self._operations())

    def _operations(self) -> Any:
        for _ in range(self.random.choice([5, 20, 60, 150])):
            kind = self.random.random()
            if kind < 0.01:
                yield ("clear",)
                self.sent.clear()
            elif kind < 0.55 and self.parents:
                yield self._sample()
            else:
                yield self._question()

    def _sample(self) -> tuple[Any, ...]:
        r = self.random
        child = r.choice(list(self.parents))
        if r.random() < 0.05:  # to another parent that is no descendant, unless loops are wanted
            i = len(self.names) if self.wild else self.names.index(child)
            self.parents[child] = r.choice([name for name in self.names[:i] if name != child])
        self.now += r.choice([0, 1, 5, 50])
        if self.wild and r.random() < 0.02:
            self.now += 512 * 30
            self.static[child] = not self.static[child]
        stamp = self.now - (r.randrange(1, 512) if r.random() < 0.2 else 0)
        known = self.sent.get((child, stamp))
        if known and not (self.wild and r.random() < 0.7):
            return known
        operation = (
            "set",
            self.parents[child],
            child,
            stamp * TICK,
            self._pose(),
            self.static[child],
        )
        if not self.static[child]:
            self.sent[child, stamp] = operation
        return operation

    def _pose(self) -> list[float]:
        r = self.random
        axis = [r.gauss(0, 1) for _ in range(3)]
        length = math.sqrt(sum(a * a for a in axis)) or 1.0
        # No two of them lie between 1e-11 and 3e-8 apart, where tf2 holds the older one and we
        # interpolate (docs/compatibility.md).
        half = r.choice([0.0, 1e-12, 1e-4, 0.1, 1.0, 3.1]) * r.uniform(0.01, 1) * r.choice([-1, 1])
        return (
            [r.uniform(-5, 5) for _ in range(3)]
            + [math.sin(half) * a / length for a in axis]
            + [math.cos(half)]
        )

    def _stamp(self) -> int:
        r = self.random
        if r.random() < 0.2:
            return 0
        known = [stamp for _, stamp in list(self.sent)[-30:]] or [self.now]
        return max(1, r.choice(known) + r.choice([0, 0, 1, -1, 3, -20, 40])) * TICK

    def _question(self) -> tuple[Any, ...]:
        r = self.random
        target, source, fixed = (
            r.choice([*self.names, "nobody"] if r.random() < 0.05 else self.names) for _ in range(3)
        )
        kind = r.random()
        if kind < 0.1:
            return ("common", target, source)
        if kind < 0.3:
            return ("full", target, self._stamp(), source, self._stamp(), fixed)
        return ("lookup", target, source, self._stamp())

    def question_beyond_tf2(self) -> tuple[str, tuple[Any, ...], dict[str, Any]]:
        """Draw a method that only we have, or an option, with its arguments."""
        r = self.random
        names = tuple(
            r.choice([*self.names, "nobody"] if r.random() < 0.05 else self.names) for _ in range(2)
        )
        reach = {"extrapolate_ns": r.choice([0, 1, 50, 512]) * TICK}
        stamps = [self._stamp() for _ in range(r.choice([1, 3, 40]))]
        if r.random() < 0.5:
            stamps.sort()
        rows = {"errors": r.choice(["raise", "nan"])}
        others = {
            name: r.choice(self.names) for name in ("axes_frame", "point_frame") if r.random() < 0.5
        }
        return r.choice([
            ("lookup_transform", (*names, stamps[0]), reach),
            ("can_transform", (*names, stamps[0]), reach),
            ("lookup_transforms", (*names, stamps), {**reach, **rows, "matrices": True}),
            ("lookup_velocity", (*names, r.choice([stamps, stamps[0], None])), {**rows, **others}),
            ("transform_points", (*names, [(1.0, 2.0, 3.0)] * len(stamps), stamps), rows),
            ("lookup_newest", names, {}),
            ("lookup_newest", names, {"max_age_ns": 50 * TICK, "now_ns": stamps[0]}),
            ("time_range", names, {}),
        ])  # fmt: skip


def tf_bytes(parent: str, child: str, *, x: float = 0.0, stamp_s: int = 1) -> bytes:
    """A TFMessage with one transform, in CDR."""
    transform: Any = msg.get_message("geometry_msgs/msg/TransformStamped")(child_frame_id=child)
    transform.header.frame_id = parent
    transform.header.stamp.sec = stamp_s
    transform.transform.translation.x = x
    message: Any = msg.get_message("tf2_msgs/msg/TFMessage")(transforms=[transform])
    return msg.serialize(message)


@pytest.fixture(scope="session")
def make_world() -> Callable[..., World]:
    return World
