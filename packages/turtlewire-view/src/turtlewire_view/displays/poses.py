"""Single poses, arrays of poses, and odometry."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire.geometry import arrays
from turtlewire_view.displays.content import (
    Content,
    Display,
    Output,
    UnusableMessageError,
    Vector,
    frame_of,
    stamp_ns_of,
)
from turtlewire_view.displays.numeric import (
    LARGEST,
    anchored,
    finite_pose,
    pose_rows,
    spread,
    warn_of_quaternions,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["OdometryDisplay", "PathDisplay", "PoseArrayDisplay", "PoseDisplay", "covariance_shape"]


class PoseDisplay(Display):
    """A ``geometry_msgs/msg/PoseStamped`` or ``PoseWithCovarianceStamped``."""

    kind = "pose"

    def _outputs(self, message: Any) -> list[Output]:
        header = self._header(message.pose)
        return [Content(header, {}, frame_of(message), stamp_ns_of(message))]

    def _header(self, pose: Any) -> dict[str, Any]:
        """Return the pose and, if it has one, its covariance."""
        if not hasattr(pose, "covariance"):
            return {"at": finite_pose(pose, self.warn), "covariance": None}
        shape = covariance_shape(pose.covariance, self.warn)
        return {"at": finite_pose(pose.pose, self.warn), "covariance": shape}


class OdometryDisplay(PoseDisplay):
    """The last poses of a ``nav_msgs/msg/Odometry``.

    Options: ``keep`` (100) poses, each ``position_tolerance`` (0.1 m) or ``angle_tolerance``
    (0.1 rad) away from the one before it. The shape, its colours and sizes are the page's.
    """

    kind = "odometry"

    def __init__(self, options: Mapping[str, object] | None = None, **keywords: Any) -> None:
        super().__init__(options, **keywords)
        self._last: tuple[str, list[float]] | None = None

    def _outputs(self, message: Any) -> list[Output]:
        frame_id, header = frame_of(message), self._header(message.pose)
        if self._last is not None and not self._moved(frame_id, header["at"]):
            return []
        self._last = (frame_id, header["at"])
        content = Content(header, {}, frame_id, stamp_ns_of(message))
        return self._keep(content, self.options.number("keep"))

    def _moved(self, frame_id: str, pose: list[float]) -> bool:
        assert self._last is not None
        last_frame, last = self._last
        cosine = min(1.0, abs(math.fsum(a * b for a, b in zip(pose[3:], last[3:], strict=True))))
        return (
            frame_id != last_frame
            or math.dist(pose[:3], last[:3]) >= self.options.number("position_tolerance")
            or 2 * math.acos(cosine) >= self.options.number("angle_tolerance")
        )


class PoseArrayDisplay(Display):
    """The poses of a ``geometry_msgs/msg/PoseArray``: ``points`` and ``rotations`` (xyzw)."""

    kind = "pose_array"

    def _outputs(self, message: Any) -> list[Output]:
        arrays, anchor = _drawn_poses(self, message.poses, rotations=True)
        header = {"count": len(arrays["points"])}
        if message.poses and not header["count"]:
            raise UnusableMessageError("no pose is finite")
        return [Content(header, arrays, frame_of(message), stamp_ns_of(message), anchor=anchor)]


def _drawn_poses(
    display: Display, sent: Sequence[Any], *, rotations: bool
) -> tuple[dict[str, NDArray[Any]], Vector]:
    """Return the arrays of the finite poses within the budget, and the anchor of their points.

    Poses may be stamped. The display warns of poses that are not finite or beyond the budget.
    """
    kept = [getattr(sent[at], "pose", sent[at]) for at in spread(len(sent), display.budget)]
    rows = [
        (p.x, p.y, p.z, q.x, q.y, q.z, q.w)
        for p, q in ((pose.position, pose.orientation) for pose in kept)
    ]
    poses, finite = pose_rows(rows)
    if not finite.all():
        display.warn(f"{np.count_nonzero(~finite)} of {len(sent)} poses are not finite")
    if rotations:
        warn_of_quaternions(rows, display.warn)
    if len(kept) < len(sent):
        display.warn(f"{len(kept)} of {len(sent)} poses are drawn")
    points, anchor = anchored(poses[:, :3])
    arrays = {"points": points}
    if rotations:
        arrays["rotations"] = poses[:, 3:].astype(np.float32)
    return arrays, anchor


def covariance_shape(covariance: Any, warn: Callable[[str], None]) -> dict[str, Any] | None:
    """Return the shape of a 6x6 covariance: x, y, z, roll, pitch, yaw.

    Args:
        covariance: 36 numbers, row by row.
        warn: Gets a message if they are not a covariance.

    Returns:
        ``radii`` of one standard deviation along the axes of ``rotation`` (xyzw), for the position;
        ``yaw``, the standard deviation of the heading in radians. None if it is all zeros, which
        means that the sender does not know, or no covariance.
    """
    matrix = np.asarray(covariance, dtype=np.float64).reshape(6, 6)
    if not matrix.any():
        return None
    if not (np.abs(np.nan_to_num(matrix, nan=math.inf)) < LARGEST).all():
        warn("the covariance holds a number that is not finite or too large")
        return None
    position = (matrix[:3, :3] + matrix[:3, :3].T) / 2
    values, vectors = np.linalg.eigh(position)
    tolerance = 1e-9 * max(1.0, float(np.abs(values).max()))
    if values[0] < -tolerance or matrix[5, 5] < 0:
        warn("the covariance has negative variances")
        return None
    radii = np.sqrt(np.maximum(values, 0.0))
    if np.linalg.det(vectors) < 0:
        vectors[:, 0] = -vectors[:, 0]
    return {
        "radii": [float(radius) for radius in radii],
        "rotation": arrays.from_matrices(vectors).tolist(),
        "yaw": min(math.pi, math.sqrt(float(matrix[5, 5]))),
    }


class PathDisplay(Display):
    """The line of a ``nav_msgs/msg/Path``, and its poses as axes or arrows.

    As in RViz all poses are taken in the frame of the path's own header.

    Options: ``buffer_length`` is how many paths stay (1), ``pose_style`` (``none``, ``axes``,
    ``arrows``) sends the orientations. Colours and widths are the page's.
    """

    kind = "path"
    replays = True

    def _outputs(self, message: Any) -> list[Output]:
        rotations = self.options.text("pose_style") != "none"
        arrays, anchor = _drawn_poses(self, message.poses, rotations=rotations)
        header = {"count": len(arrays["points"])}
        content = Content(header, arrays, frame_of(message), stamp_ns_of(message), anchor=anchor)
        return self._keep(content, self.options.number("buffer_length"))
