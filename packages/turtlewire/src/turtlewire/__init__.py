"""ROS 2's transform system for Python, without a ROS installation.

===================  =====================================================================
module               what it holds
===================  =====================================================================
`bag`                rosbag2 folders, MCAP and sqlite3, read and written
`cli`                the ``turtlewire`` command and its verbs
`demo`               ``python -m turtlewire.demo``: one turtle follows another
`doctor`             checks of the installation, the graph and the transforms
`errors`             every error that turtlewire raises on purpose
`geometry`           quaternions, poses and matrices as numbers
`msg`                interface definitions, message classes, CDR and type hashes
`platforms`          what this platform can do, and which core is asked for
`plugins`            entry points that installed packages declare
`program`            how a command ends whose output cannot be written
`terminal`           command lines, keys and text of terminals
`testing`            a domain, a filled buffer and waiting, for users' tests
`tf`                 the transform buffer, the listener that fills it, and its pictures
`trajectory`         poses over time: sampled, in files, compared
`urdf`               robots: a parser of URDF and forward kinematics
`wake_up`            a wait of the main thread that a signal may interrupt at any moment
`web`                a small HTTP and WebSocket server for this machine's browsers
`wire`               the middleware: bytes, QoS, names and the graph
===================  =====================================================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from turtlewire.tf.buffer import Buffer as Buffer
    from turtlewire.tf.buffer import Transform as Transform
    from turtlewire.tf.status import LookupStatus as LookupStatus

    __version__: str

__all__ = ["Buffer", "LookupStatus", "Transform", "__version__"]


def __getattr__(name: str) -> object:
    # The core is loaded when it is first used: `import turtlewire.msg` and its like stay light.
    if name not in __all__:
        raise AttributeError(f"module 'turtlewire' has no attribute {name!r}")
    value = _version() if name == "__version__" else _of_the_buffer(name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)


def _version() -> str:
    from importlib.metadata import version

    return version("turtlewire")


def _of_the_buffer(name: str) -> object:
    from turtlewire.tf import buffer, status

    return getattr(status if name == "LookupStatus" else buffer, name)
