"""The differences between the releases of tf2, as in the compiled core."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from turtlewire.geometry import poses

if TYPE_CHECKING:
    from turtlewire.geometry.poses import Pose

__all__ = ["ENGINE", "Rules", "rules_of"]


class Rules(NamedTuple):
    """The behaviour of a tree where the releases of tf2 differ.

    Attributes:
        no_time: A newest stamp that does not count for the latest common time; None: each counts.
        keeps_rotations: Stores quaternions as they were given, if they are nearly unit; otherwise
            by way of a matrix, which normalises any length.
        tells_emptied: Says in the text of a failed lookup that a link has no data at all.
        clears_static: Forgets static poses, too, when the tree is cleared.
    """

    no_time: int | None = None
    keeps_rotations: bool = False
    tells_emptied: bool = False
    clears_static: bool = False

    def stored(self, pose: Pose) -> Pose:
        """Return a pose as it is stored, and given as an answer."""
        return pose if self.keeps_rotations else poses.canonical(pose)

    def compose(self, a: Pose, b: Pose) -> Pose:
        """Return ``a_from_c`` for ``a_from_b`` and ``b_from_c``."""
        return (poses.compose_scaling if self.keeps_rotations else poses.compose)(a, b)

    def between(self, a: Pose, b: Pose) -> Pose:
        """Return ``a_from_b`` for ``top_from_a`` and ``top_from_b``."""
        return (poses.between_scaling if self.keeps_rotations else poses.between)(a, b)

    def interpolate(self, older: Pose, newer: Pose, ratio: float) -> Pose:
        """Return the pose at a fraction of the way from ``older`` to ``newer``."""
        mix = poses.interpolate_scaling if self.keeps_rotations else poses.interpolate
        return mix(older, newer, ratio)


ENGINE = Rules()
"""Those of a buffer that follows no release."""


def rules_of(year: int) -> Rules:
    """Return the rules of the release of a year: Jazzy 2024, Kilted 2025, Lyrical 2026."""
    keeps = tells = year >= 2025
    return Rules(0, keeps_rotations=keeps, tells_emptied=tells, clears_static=year >= 2026)
