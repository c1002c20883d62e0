"""A completer for arguments of a command line that have no completions.

:mod:`ros2launch.command.launch` hands it on; its own import would make `ros2 launch` start later.
"""

from __future__ import annotations

from typing import Any

from argcomplete.completers import SuppressCompleter


class SuppressCompleterWorkaround(SuppressCompleter):
    """Gives no completions, whether argcomplete calls it or asks for its ``suppress``."""

    def __call__(self, *args: Any, **kwargs: Any) -> tuple[str, ...]:
        """Return no completions."""
        del args, kwargs
        return ()
