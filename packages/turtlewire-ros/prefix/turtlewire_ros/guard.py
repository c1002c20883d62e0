# PYTHON_ARGCOMPLETE_OK
"""Starts ``ros2``, unless packages of a real ROS 2 are mixed in.

In a shell that sourced a real ROS 2, its packages come before ours. A mixture of both fails with
errors that do not name the cause. This module is the entry point because no other ROS 2 has a
package of its name.
"""

from __future__ import annotations

import os
import signal


def main() -> int | str:
    """Run the ``ros2`` command line of this process.

    Returns:
        What ``sys.exit`` takes: the exit status, or the text of an error.
    """
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _end)
    try:
        foreign = foreign_package()
        if foreign is not None:
            remedy = "Use a shell in which no other ROS 2 is sourced, or unset PYTHONPATH."
            fault = f"ros2: {foreign} belongs to another ROS 2 and hides turtlewire's package."
            return f"{fault} {remedy}"
        from ros2cli.main import main as run

        return run()
    except KeyboardInterrupt:  # before the command line was read
        return 2


def _end(*_: object) -> None:
    """Ctrl-C before the verb runs, which restores Python's handler.

    Until then nearly all time goes into imports, and Python drops an exception that comes at the
    end of one.
    """
    os._exit(2)


def foreign_package() -> str | None:
    """The folder of the first package that Python would import from another ROS 2, or None."""
    from importlib.util import find_spec

    shelf = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
    for name in ("rclpy", "ros2cli"):
        spec = find_spec(name)
        # In a wheel all packages lie in one folder; in the sources each lies on its shelf.
        ours = {os.path.join(shelf, name), os.path.join(os.path.dirname(shelf), name, name)}
        for folder in (spec and spec.submodule_search_locations) or ():
            if os.path.realpath(folder) not in ours:
                return folder
    return None
