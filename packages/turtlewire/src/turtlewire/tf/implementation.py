"""Chooses the compiled core of the buffer, or the plain-Python core if that is missing.

The environment decides when this module is first imported:

- ``TURTLEWIRE_CORE=python`` chooses the plain-Python core, ``TURTLEWIRE_CORE=native`` requires the
  compiled one; any other value is ignored with one line on stderr (by
  :mod:`turtlewire.platforms`);
- without it the compiled core is used if it is installed (``scripts/setup`` and
  ``turtlewire doctor`` say how to get it);
- ``TURTLEWIRE_REQUIRE_NATIVE=1`` makes a missing compiled core an ImportError.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from turtlewire.platforms import asked_core, in_browser

__all__ = ["CORE", "BaseBuffer", "RecordWalk", "Transform"]


def _choose() -> str:
    wanted = asked_core()
    if wanted == "python" or (wanted != "native" and in_browser()):
        return "python"
    try:
        import turtlewire._native  # noqa: F401
    except ModuleNotFoundError as error:
        if error.name != "turtlewire._native":
            raise
        if wanted == "native" or os.environ.get("TURTLEWIRE_REQUIRE_NATIVE", "0") not in {"", "0"}:
            raise ImportError(
                "the compiled core of turtlewire is required here, but it is not built"
            ) from error
        return "python"
    return "native"


CORE = _choose()
"""Which core runs: ``native`` or ``python``."""

if TYPE_CHECKING or CORE == "native":
    from turtlewire._native import Buffer as BaseBuffer
    from turtlewire._native import RecordWalk, Transform
else:
    from turtlewire.tf.plain import Buffer as BaseBuffer
    from turtlewire.tf.plain import RecordWalk, Transform
