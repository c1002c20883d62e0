"""Path: a line through poses."""

from __future__ import annotations

from itertools import count
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire_view.displays.content import (
    Content,
    Display,
    Output,
    Removal,
    frame_of,
    stamp_ns_of,
)
from turtlewire_view.displays.numeric import anchored, pose_rows, spread, warn_of_quaternions

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["PathDisplay"]


class PathDisplay(Display):
    """The line of a ``nav_msgs/msg/Path``, and its poses as axes or arrows.

    As in RViz all poses are taken in the frame of the path's own header.

    Options: ``buffer_length`` is how many paths stay (1), ``pose_style`` (``none``, ``axes``,
    ``arrows``) sends the orientations. Colours and widths are the page's.
    """

    kind = "path"
    replays = True

    def __init__(self, options: Mapping[str, object] | None = None, **keywords: Any) -> None:
        super().__init__(options, **keywords)
        self._numbers = count()
        self._parts: list[str] = []

    def _outputs(self, message: Any) -> list[Output]:
        frame_id = frame_of(message)
        kept = [message.poses[at].pose for at in spread(len(message.poses), self.budget)]
        rows = [
            (p.x, p.y, p.z, q.x, q.y, q.z, q.w)
            for p, q in ((pose.position, pose.orientation) for pose in kept)
        ]
        poses, finite = pose_rows(rows)
        if not finite.all():
            self.warn(f"{np.count_nonzero(~finite)} of {len(message.poses)} poses are not finite")
        if len(kept) < len(message.poses):
            self.warn(f"{len(kept)} of {len(message.poses)} poses are drawn")
        points, anchor = anchored(poses[:, :3])
        arrays = {"points": points}
        if self.options.text("pose_style") != "none":
            warn_of_quaternions(rows, self.warn)
            arrays["rotations"] = poses[:, 3:].astype(np.float32)
        part = str(next(self._numbers))
        header = {"count": len(points)}
        self._parts.append(part)
        outputs: list[Output] = [
            Content(header, arrays, frame_id, stamp_ns_of(message), part, anchor)
        ]
        while len(self._parts) > self.options.number("buffer_length"):
            outputs.append(Removal(self._parts.pop(0)))
        return outputs
