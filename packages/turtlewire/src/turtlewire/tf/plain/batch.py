"""The methods that take and return arrays: loops over single lookups.

The compiled core documents them.
"""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Any

from turtlewire.geometry.poses import IDENTITY, Pose, compose
from turtlewire.geometry.quaternions import Quaternion, Vector, conjugate, multiply, rotate
from turtlewire.tf.plain import arguments
from turtlewire.tf.plain.checks import check_frames, nanoseconds, numbers
from turtlewire.tf.plain.failure import Failure
from turtlewire.tf.status import LookupStatus

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from turtlewire.tf.plain.shared_tree import SharedTree

#: The first start of an interval.
_FIRST_NS = 10_000


def lookup_batch(
    self: SharedTree,
    target_frame: str,
    source_frame: str,
    stamps: ArrayLike,
    *,
    matrices: bool = False,
    out: NDArray[np.float64] | None = None,
    status: NDArray[np.uint8] | None = None,
) -> NDArray[np.float64]:
    """`lookup_transform` at many times: (N, 7), or (N, 4, 4) with ``matrices``."""
    check_frames(target_frame=target_frame, source_frame=source_frame)
    times = arguments.stamp_list(stamps)
    result = arguments.output_array(out, (len(times), 4, 4) if matrices else (len(times), 7))
    for i, pose in enumerate(_poses(self, target_frame, source_frame, times, status)):
        result[i] = _matrix(pose) if matrices else pose
    return result


def lookup_all(
    self: SharedTree, target_frame: str, stamp_ns: int = 0
) -> tuple[list[str], NDArray[np.float64], NDArray[np.int64]]:
    """Return the poses of all frames in one frame at one time."""
    import numpy as np

    check_frames(target_frame=target_frame)
    (stamp_ns,) = nanoseconds(stamp_ns=stamp_ns)
    frames, poses, stamps = [], [], []
    with self._changed:
        self._checked(
            lambda: self._tree.check_name(target_frame, "lookupTransform", "target_frame")
        )
        for frame in self._tree.frames:
            found = _attempt(
                lambda frame=frame: self._tree.lookup(  # type: ignore[misc]
                    target_frame, frame, stamp_ns, "lookupTransform"
                )
            )
            if isinstance(found, tuple):
                frames.append(frame)
                stamps.append(found[0])
                poses.append(found[1])
    return (
        frames,
        np.array(poses, dtype=np.float64).reshape(-1, 7),
        np.array(stamps, dtype=np.int64),
    )


def transform_points(
    self: SharedTree,
    target_frame: str,
    source_frame: str,
    points: ArrayLike,
    stamps: int | ArrayLike = 0,
    *,
    fixed_frame: str | None = None,
    target_stamp_ns: int = 0,
    out: NDArray[Any] | None = None,
    status: NDArray[np.uint8] | None = None,
) -> NDArray[Any]:
    """Express points (N, 3) of the source frame in the target frame.

    ``stamps`` is one time for all points, or one for each.
    """
    own_target = target_frame if fixed_frame is None else fixed_frame
    check_frames(target_frame=target_frame, source_frame=source_frame, fixed_frame=own_target)
    (target_stamp_ns,) = nanoseconds(target_stamp_ns=target_stamp_ns)
    if fixed_frame is None and target_stamp_ns:
        raise ValueError("target_stamp_ns needs fixed_frame, the frame that joins the two times")
    given, result = arguments.point_arrays(points, out)
    last = (
        _pose(self, target_frame, own_target, target_stamp_ns)
        if fixed_frame is not None
        else IDENTITY
    )
    times, single = arguments.times_of(stamps)
    if single:
        if status is not None:
            raise ValueError("status is for a stamp for each point")
        poses: Iterable[Pose] = [_pose(self, own_target, source_frame, times[0])] * len(given)
    else:
        if len(times) != len(given):
            raise ValueError("stamps must be one int, or one for each point")
        poses = _poses(self, own_target, source_frame, times, status)
    for i, pose in enumerate(poses):
        x, y, z = (float(value) for value in given[i])
        result[i] = compose(last, compose(pose, (x, y, z, 0.0, 0.0, 0.0, 1.0)))[:3]
    return result


def lookup_velocity(
    self: SharedTree,
    tracking_frame: str,
    observation_frame: str,
    stamps: int | ArrayLike = 0,
    *,
    interval_ns: int = 100_000_000,
    reference_frame: str | None = None,
    point: Vector = (0.0, 0.0, 0.0),
    point_frame: str | None = None,
    out: NDArray[np.float64] | None = None,
    status: NDArray[np.uint8] | None = None,
) -> NDArray[np.float64]:
    """Return the velocity of a body: vx, vy, vz in m/s and wx, wy, wz in rad/s.

    Shape (6,), or (N, 6) for an array of stamps.
    """
    check_frames(tracking_frame=tracking_frame, observation_frame=observation_frame)
    (interval_ns,) = nanoseconds(interval_ns=interval_ns)
    if interval_ns <= 0:
        raise ValueError("interval_ns must be positive")
    px, py, pz = numbers("point", point, 3)
    times, single = arguments.times_of(stamps)
    result = arguments.output_array(out, (6,) if single else (len(times), 6))
    arguments.check_status(status, len(times))
    latest = _attempt(lambda: self._tree.latest_common_time(observation_frame, tracking_frame))
    newest = latest if isinstance(latest, int) else 0
    axes, fixed = reference_frame or observation_frame, point_frame or tracking_frame

    def measure(t: int) -> tuple[float, ...]:
        end = min(t + interval_ns // 2, newest) if t <= newest else t
        last = _bare(self, observation_frame, tracking_frame, end)
        start = _interval_start(end, interval_ns)
        first = _bare(self, observation_frame, tracking_frame, start)
        turn = _bare(self, axes, observation_frame, t)[3:]
        at = compose(_bare(self, tracking_frame, fixed, t), (px, py, pz, 0.0, 0.0, 0.0, 1.0))[:3]
        linear, angular = _mean_velocity(first, last, at, (end - start) / 1e9)
        return (*rotate(turn, linear), *rotate(turn, angular))

    for i, stamp in enumerate(times):
        with self._changed:
            row = _with_status(self, partial(measure, stamp or newest), status, i)
        target = result if single else result[i]
        target[:] = math.nan if row is None else row
    return result


def _interval_start(end: int, interval_ns: int) -> int:
    """Return the start of an interval that ends there.

    As in ROS 2, one that would begin before time 0, or at 0, which means the latest time, begins 10
    microseconds after it.
    """
    return max(end - interval_ns, _FIRST_NS) if end > _FIRST_NS else end - interval_ns


def _mean_velocity(first: Pose, last: Pose, point: Vector, seconds: float) -> tuple[Vector, Vector]:
    """Linear velocity of a point, from start and end of its way, and angular velocity.

    Both are in the observer's axes.
    """
    begin, end = (compose(pose, (*point, 0.0, 0.0, 0.0, 1.0)) for pose in (first, last))
    linear = (
        (end[0] - begin[0]) / seconds,
        (end[1] - begin[1]) / seconds,
        (end[2] - begin[2]) / seconds,
    )
    x, y, z, w = multiply(last[3:], conjugate(first[3:]))
    sine = math.sqrt(x * x + y * y + z * z)
    factor = (
        math.copysign(2.0 if sine < 1e-9 else 2.0 * math.atan2(sine, abs(w)) / sine, w) / seconds
    )
    return linear, (factor * x, factor * y, factor * z)


def _bare(self: SharedTree, target: str, source: str, stamp: int) -> Pose:
    return self._tree.lookup(target, source, stamp, "lookupTransform")[1]


def _pose(self: SharedTree, target: str, source: str, stamp: int) -> Pose:
    with self._changed:
        return self._checked(lambda: _bare(self, target, source, stamp))


def _poses(
    self: SharedTree, target: str, source: str, stamps: list[int], status: NDArray[np.uint8] | None
) -> Iterable[Pose]:
    arguments.check_status(status, len(stamps))
    for i, stamp in enumerate(stamps):
        with self._changed:
            pose = _with_status(
                self,
                lambda stamp=stamp: _bare(self, target, source, stamp),  # type: ignore[misc]
                status,
                i,
            )
        yield pose or (math.nan,) * 7


def _attempt(ask: Callable[[], Any]) -> Any:
    try:
        return ask()
    except Failure as failure:
        return failure.status


def _with_status(
    self: SharedTree, ask: Callable[[], Any], status: NDArray[np.uint8] | None, i: int
) -> Any:
    """Return the answer, or None with the reason noted in ``status``.

    Without ``status`` the failure raises.
    """
    if status is None:
        return self._checked(ask)
    answer = _attempt(ask)
    status[i] = answer if isinstance(answer, LookupStatus) else LookupStatus.OK
    return None if isinstance(answer, LookupStatus) else answer


def _matrix(pose: Pose) -> NDArray[np.float64]:
    from turtlewire.tf.arrays import pose_matrix
    from turtlewire.tf.plain.transform import Transform

    rotation: Quaternion = pose[3:]
    return pose_matrix(Transform("", "", 0, pose[:3], rotation))
