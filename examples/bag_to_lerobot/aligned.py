"""Reads the joint states, poses, commands and images of a bag at the same moments.

Each topic of a bag has its own rate. A data set has rows: at each step the angles of the joints,
the pose of a frame, the command and an image. `align` makes the rows of whole columns.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from turtlewire import Buffer

if TYPE_CHECKING:
    from turtlewire.bag import Bag, Columns

SECOND = 1_000_000_000
POSE = ("x", "y", "z", "qx", "qy", "qz", "qw")


@dataclass
class Wanted:
    """The parts of a row.

    Attributes:
        fps: Rows a second.
        joints: The topic of the joint states; empty for none.
        action: The topic of the commands.
        fields: The fields of a command, named as `Bag.columns` names them.
        poses: The target and source frames of each pose.
        cameras: The topic of each camera's images.
        nearest: Take the nearest image, not the latest one before the step.
    """

    fps: int
    joints: str
    action: str
    fields: list[str]
    poses: list[tuple[str, str]] = field(default_factory=list)
    cameras: dict[str, str] = field(default_factory=dict)
    nearest: bool = False


class Signal(NamedTuple):
    """Numbers over time: stamps ``(N,)`` in nanoseconds, values ``(N, k)`` and k names."""

    stamps_ns: np.ndarray
    values: np.ndarray
    names: list[str]


class Rows(NamedTuple):
    """The rows of an episode.

    Attributes:
        stamps_ns: The time of each row, nanoseconds, ``(N,)``.
        state: The angles of the joints and the poses, ``(N, k)``.
        state_names: The names of the k numbers.
        action: The command in force, ``(N, m)``.
        action_names: The names of the m numbers.
        images: When each camera's image was recorded, nanoseconds, ``(N,)``.
    """

    stamps_ns: np.ndarray
    state: np.ndarray
    state_names: list[str]
    action: np.ndarray
    action_names: list[str]
    images: dict[str, np.ndarray]


def align(bag: Bag, wanted: Wanted) -> Rows:
    """Return the rows of a bag, from the first moment that has all parts to the last one.

    Raises:
        BagError: A topic or a field does not exist.
        TransformException: A frame does not exist, or is not in the tree of the other.
        ValueError: A topic has no messages, or no moment has all parts.
    """
    joints, clock = joint_signals(bag, wanted.joints) if wanted.joints else ([], None)
    cameras = {name: bag.columns(of, "header.stamp") for name, of in wanted.cameras.items()}
    action = command_signal(bag, wanted, clock or next(iter(cameras.values()), None))
    # An image that is older than the one before it must not disturb the search.
    images = {name: np.maximum.accumulate(filled(of).stamps_ns) for name, of in cameras.items()}
    buffer = Buffer.from_bag(bag) if wanted.poses else Buffer()
    ranges = [buffer.time_range(*pose) for pose in wanted.poses]
    ranges += [(at[0], at[-1]) for at in (*(j.stamps_ns for j in joints), *images.values())]
    # A static transform has no range.
    ranges = [each for each in ranges if each] or [(action.stamps_ns[0], action.stamps_ns[-1])]
    steps = steps_within(ranges, action.stamps_ns[0], wanted.fps)
    parts = [interpolated(signal, steps) for signal in joints]
    parts += [buffer.lookup_transforms(*pose, steps) for pose in wanted.poses]
    names = [name for signal in joints for name in signal.names]
    names += [f"{source}.{number}" for _, source in wanted.poses for number in POSE]
    held = action.values[last_before(action.stamps_ns, steps)]
    choose = nearest_to if wanted.nearest else last_before
    recorded = {
        name: cameras[name].log_times_ns[choose(stamps, steps)] for name, stamps in images.items()
    }
    return Rows(steps, np.hstack(parts), names, held, action.names, recorded)


def filled(columns: Columns) -> Columns:
    """Return the columns; ValueError if the topic has no messages."""
    if len(columns.stamps_ns) == 0:
        raise ValueError(f"{columns.topic} has no messages in the bag")
    return columns


def joint_signals(bag: Bag, topic: str) -> tuple[list[Signal], Columns]:
    """Return the positions of the joints, a signal for each joint, and their messages.

    Publishers may send other joints, or the same joints in another order. A message without
    positions, such as one that has only velocities, is left out.
    """
    table = filled(bag.columns(topic, "name", "position"))
    rows: dict[tuple[str, ...], list[int]] = {}
    for row, (names, positions) in enumerate(zip(table["name"], table["position"], strict=True)):
        if len(positions) == len(names):
            rows.setdefault(tuple(names), []).append(row)
        elif len(positions):
            raise ValueError(f"{topic} has {len(names)} names, but {len(positions)} positions")
    found: dict[str, list[tuple[np.ndarray, np.ndarray]]] = {}
    for names, at in rows.items():
        values = np.concatenate(table["position"][at]).reshape(len(at), len(names))
        for name, column in zip(names, values.T, strict=True):
            found.setdefault(name, []).append((table.stamps_ns[at], column))
    if not found:
        raise ValueError(f"{topic} has no positions of joints in the bag")
    signals = []
    for name, parts in found.items():
        stamps, columns = (np.concatenate(each) for each in zip(*parts, strict=True))
        signals.append(in_order(stamps, columns[:, None], [f"{name}.pos"]))
    return signals, table


def command_signal(bag: Bag, wanted: Wanted, clock: Columns | None) -> Signal:
    """Return the commands over time.

    Commands often have no header, only the time when they were recorded. That is another clock than
    the stamps' if the robot is simulated. `clock` has messages with both times.
    """
    table = filled(bag.columns(wanted.action, *wanted.fields))
    stamps = table.stamps_ns
    if clock is not None and np.array_equal(stamps, table.log_times_ns):
        stamps = on_the_clock(stamps, clock)
    values, names = [], []
    for name, column in table.items():
        numbers = numbers_of(column, f"{wanted.action}:{name}")
        values.append(numbers.reshape(len(stamps), -1))
        width = values[-1].shape[1]
        names += [name] if numbers.ndim == 1 else [f"{name}[{k}]" for k in range(width)]
    return in_order(stamps, np.hstack(values), names)


def numbers_of(column: np.ndarray, name: str) -> np.ndarray:
    """Return a column of numbers, or of lists of one length; ValueError if it is another one."""
    if column.dtype == object:
        lengths = sorted({np.size(each) for each in column})
        if len(lengths) > 1:
            found = f"{lengths[0]} to {lengths[-1]} numbers"
            raise ValueError(f"{name} has {found}; each row needs the same number")
        column = np.stack(column)
    if column.dtype.kind not in "biuf" or column.size == 0:
        raise ValueError(f"{name} has no numbers")
    return column


def on_the_clock(logged_ns: np.ndarray, clock: Columns) -> np.ndarray:
    """Return stamps for the times when messages were recorded, interpolated between others."""
    delays = clock.log_times_ns - clock.stamps_ns
    # float64 is exact for small numbers only.
    start, least = clock.log_times_ns[0], delays.min()
    found = np.interp(logged_ns - start, clock.log_times_ns - start, delays - least)
    return logged_ns - least - np.rint(found).astype(np.int64)


def in_order(stamps_ns: np.ndarray, values: np.ndarray, names: list[str]) -> Signal:
    """Return a signal in order of its stamps."""
    order = np.argsort(stamps_ns, kind="stable")
    return Signal(stamps_ns[order], values[order], names)


def steps_within(ranges: list[tuple[int, int]], first_command: int, fps: int) -> np.ndarray:
    """Return the times of the rows; the last command stays in force until the end."""
    start = max(first_command, *(first for first, _ in ranges))
    end = min(last for _, last in ranges)
    if end < start:
        late = (start - end) / SECOND
        raise ValueError(f"no moment has all parts: one begins {late:.3f} s after another ends")
    return start + np.arange((end - start) * fps // SECOND + 1) * SECOND // fps


def interpolated(signal: Signal, steps: np.ndarray) -> np.ndarray:
    """Return the values at each step, by linear interpolation."""
    since = signal.stamps_ns - steps[0]  # float64 is exact for small numbers only
    columns = [np.interp(steps - steps[0], since, column) for column in signal.values.T]
    return np.column_stack(columns)


def last_before(stamps: np.ndarray, steps: np.ndarray) -> np.ndarray:
    """Return the number of the last stamp that is not after each step."""
    return np.searchsorted(stamps, steps, side="right") - 1


def nearest_to(stamps: np.ndarray, steps: np.ndarray) -> np.ndarray:
    """Return the number of the stamp that is nearest to each step."""
    before = last_before(stamps, steps)
    after = np.minimum(before + 1, len(stamps) - 1)
    return np.where(stamps[after] - steps < steps - stamps[before], after, before)
