"""The prefixes in which packages are searched."""

from __future__ import annotations

from ament_index_python.constants import AMENT_PREFIX_PATH_ENV_VAR

__all__ = ["AMENT_PREFIX_PATH_ENV_VAR", "get_search_paths"]


def get_search_paths() -> list[str]:
    """Return the prefixes of ``AMENT_PREFIX_PATH`` that exist, then that of this distribution.

    Raises:
        OSError: No prefix was found.
    """
    from turtlewire_ros.prefix import prefixes

    paths = prefixes()
    if not paths:
        raise OSError(f"Environment variable '{AMENT_PREFIX_PATH_ENV_VAR}' is not set or empty")
    return paths
