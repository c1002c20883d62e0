"""The methods that take and return arrays: loops over single lookups.

The compiled core documents them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from functools import partial
from typing import TYPE_CHECKING, Any, Literal

from turtlewire.errors import ExtrapolationException
from turtlewire.geometry.poses import IDENTITY, Pose, compose
from turtlewire.geometry.quaternions import Quaternion, Vector, conjugate, multiply, rotate
from turtlewire.tf.answers import FramePoses
from turtlewire.tf.plain import checks
from turtlewire.tf.plain.checks import LIMIT, check_frames, moments, nanoseconds, numbers
from turtlewire.tf.plain.failure import Failure
from turtlewire.tf.plain.status import LookupStatus

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from turtlewire.tf.plain.shared_tree import SharedTree

#: The first start of an interval.
_FIRST_NS = 10_000


def lookup_transforms(
    self: SharedTree,
    target_frame: str,
    source_frame: str,
    stamps: ArrayLike,
    *,
    errors: Literal["raise", "nan"] = "raise",
    extrapolate_ns: int = 0,
    matrices: bool = False,
    out: NDArray[np.float64] | None = None,
) -> NDArray[np.float64]:
    """`lookup_transform` at many times: (N, 7), or (N, 4, 4) with ``matrices``."""
    check_frames(target_frame=target_frame, source_frame=source_frame)
    nan = checks.check_errors(errors)
    (beyond,) = nanoseconds(extrapolate_ns=extrapolate_ns)
    if beyond < 0:
        raise ValueError("extrapolate_ns must not be negative")
    times = checks.stamp_list(stamps)
    result = checks.output_array(out, (len(times), 4, 4) if matrices else (len(times), 7))
    for i, pose in enumerate(_poses(self, target_frame, source_frame, times, nan, beyond)):
        result[i] = _matrix(pose) if matrices else pose
    return result


def lookup_all(self: SharedTree, target_frame: str, stamp_ns: int | None = None) -> FramePoses:
    """Return the poses of all frames in one frame at one time."""
    import numpy as np

    check_frames(target_frame=target_frame)
    (stamp,) = moments(stamp_ns=stamp_ns)
    frames, poses, stamps = [], [], []
    with self._lock:
        self._checked(
            lambda: self._tree.check_name(target_frame, "lookupTransform", "target_frame")
        )
        for frame in self._tree.frames:
            found = _attempt(partial(_found, self, target_frame, frame, stamp))
            if isinstance(found, tuple):
                frames.append(frame)
                stamps.append(-LIMIT if found[0] is None else found[0])
                poses.append(found[1])
    return FramePoses(
        frames,
        np.array(poses, dtype=np.float64).reshape(-1, 7),
        np.array(stamps, dtype=np.int64),
    )


def transform_points(
    self: SharedTree,
    target_frame: str,
    source_frame: str,
    points: ArrayLike,
    stamps: int | ArrayLike | None = None,
    *,
    fixed_frame: str | None = None,
    target_stamp_ns: int | None = None,
    errors: Literal["raise", "nan"] = "raise",
    out: NDArray[Any] | None = None,
) -> NDArray[Any]:
    """Express points (N, 3) of the source frame in the target frame.

    ``stamps`` is one time for all points, or one for each.
    """
    own_target = target_frame if fixed_frame is None else fixed_frame
    check_frames(target_frame=target_frame, source_frame=source_frame, fixed_frame=own_target)
    nan = checks.check_errors(errors)
    (target_stamp,) = moments(target_stamp_ns=target_stamp_ns)
    if fixed_frame is None and target_stamp is not None:
        raise ValueError("target_stamp_ns needs fixed_frame, the frame that joins the two times")
    given, result = checks.point_arrays(points, out)
    last = (
        _pose(self, target_frame, own_target, target_stamp) if fixed_frame is not None else IDENTITY
    )
    times, single = checks.times_of(stamps)
    if single:
        poses: Iterable[Pose] = [_pose(self, own_target, source_frame, times[0])] * len(given)
    else:
        if len(times) != len(given):
            raise ValueError(
                "stamps must be one time, or one for each point: "
                f"{len(given)} points have {len(times)} stamps"
            )
        poses = _poses(self, own_target, source_frame, times, nan)
    for i, pose in enumerate(poses):
        x, y, z = (float(value) for value in given[i])
        result[i] = compose(last, compose(pose, (x, y, z, 0.0, 0.0, 0.0, 1.0)))[:3]
    return result


def lookup_velocity(
    self: SharedTree,
    target_frame: str,
    source_frame: str,
    stamps: int | ArrayLike | None = None,
    *,
    interval_ns: int = 100_000_000,
    axes_frame: str | None = None,
    point: Vector = (0.0, 0.0, 0.0),
    point_frame: str | None = None,
    errors: Literal["raise", "nan"] = "raise",
    out: NDArray[np.float64] | None = None,
) -> NDArray[np.float64]:
    """Return the velocity of the source: vx, vy, vz in m/s and wx, wy, wz in rad/s.

    Shape (6,), or (N, 6) for an array of stamps.
    """
    check_frames(target_frame=target_frame, source_frame=source_frame)
    nan = checks.check_errors(errors)
    (interval_ns,) = nanoseconds(interval_ns=interval_ns)
    if interval_ns <= 0:
        raise ValueError("interval_ns must be positive")
    px, py, pz = numbers("point", point, 3)
    times, single = checks.times_of(stamps)
    result = checks.output_array(out, (6,) if single else (len(times), 6))
    latest = _attempt(lambda: self._tree.latest_common_time(target_frame, source_frame))
    # Between static links, any time is as good as another.
    newest = 0 if latest is None or isinstance(latest, LookupStatus) else latest
    axes, fixed = axes_frame or target_frame, point_frame or source_frame

    def measure(t: int) -> tuple[float, ...]:
        end = min(t + interval_ns // 2, newest) if t <= newest else t
        last = _bare(self, target_frame, source_frame, end)
        start = _interval_start(end, interval_ns)
        first = _bare(self, target_frame, source_frame, start)
        turn = _bare(self, axes, target_frame, t)[3:]
        at = compose(_bare(self, source_frame, fixed, t), (px, py, pz, 0.0, 0.0, 0.0, 1.0))[:3]
        linear, angular = _mean_velocity(first, last, at, (end - start) / 1e9)
        return (*rotate(turn, linear), *rotate(turn, angular))

    for i, stamp in enumerate(times):
        with self._lock:
            row = _answer(self, partial(measure, newest if stamp is None else stamp), nan)
        target = result if single else result[i]
        target[:] = math.nan if row is None else row
    return result


def _interval_start(end: int, interval_ns: int) -> int:
    """Return the start of an interval that ends there.

    As in ROS 2, whose time 0 is not a time of data, an interval that would begin at 0 or before it
    begins 10 microseconds after it.
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


def _found(
    self: SharedTree, target: str, source: str, stamp: int | None, beyond: int = 0
) -> tuple[int | None, Pose]:
    return self._tree.lookup(target, source, stamp, "lookupTransform", beyond)


def _bare(self: SharedTree, target: str, source: str, stamp: int | None, beyond: int = 0) -> Pose:
    return _found(self, target, source, stamp, beyond)[1]


def _pose(self: SharedTree, target: str, source: str, stamp: int | None) -> Pose:
    with self._lock:
        pose: Pose = _answer(self, partial(_bare, self, target, source, stamp), nan=False)
    return pose


def _poses(
    self: SharedTree,
    target: str,
    source: str,
    stamps: Iterable[int | None],
    nan: bool,
    beyond: int = 0,
) -> Iterable[Pose]:
    for stamp in stamps:
        with self._lock:
            pose = _answer(self, partial(_bare, self, target, source, stamp, beyond), nan)
        yield pose or (math.nan,) * 7


def _attempt(ask: Callable[[], Any]) -> Any:
    try:
        return ask()
    except Failure as failure:
        return failure.status


def _answer(self: SharedTree, ask: Callable[[], Any], nan: bool) -> Any:
    """Return the answer; without one, None if it is to become NaN, else the failure raises."""
    if not nan:
        try:
            return self._checked(ask)
        except ExtrapolationException as error:
            error._in_batch = True
            raise
    answer = _attempt(ask)
    return None if isinstance(answer, LookupStatus) else answer


def _matrix(pose: Pose) -> NDArray[np.float64]:
    from turtlewire.tf.arrays import pose_matrix
    from turtlewire.tf.plain.transform import Transform

    rotation: Quaternion = pose[3:]
    return pose_matrix(Transform("", "", pose[:3], rotation))
