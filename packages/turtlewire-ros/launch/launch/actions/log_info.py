"""The old module of :class:`launch.actions.LogInfo`; in Lyrical, importing it warns."""

import warnings

from launch.actions.log import LogInfo
from turtlewire.distro import LYRICAL, since

__all__ = ["LogInfo"]

if since(LYRICAL):
    warnings.warn(
        f"importing from {__name__} is deprecated, import from launch.actions.log instead",
        DeprecationWarning,
        stacklevel=2,
    )
