"""ROS 2's transform system for Python, without a ROS installation.

===================  =====================================================================
module               contents
===================  =====================================================================
`bag`                rosbag2 folders, MCAP and sqlite3, read and written
`call_errors`        errors of calls with wrong arguments, and of names of other libraries
`cli`                the ``turtlewire`` command and its verbs
`demo`               ``python -m turtlewire.demo``: one turtle follows another
`distro`             the distribution of ROS 2 that ``ROS_DISTRO`` chooses
`doctor`             checks of the installation, the graph and the transforms
`errors`             every error that turtlewire raises on purpose
`geometry`           quaternions, poses and matrices as numbers
`guarded`            calls on threads that an exception must not end
`msg`                interface definitions, message classes, CDR and type hashes
`net`                topics and transforms of a network: `connect`
`new_file`           files that appear, or replace others, when they are complete
`package_sources`    repositories of well-known packages that are missing
`path_arguments`     paths that callers pass, and suggestions for missing ones
`platforms`          capabilities of this platform, and the requested core
`plugins`            entry points that installed packages declare
`program`            ends a command whose output cannot be written
`relay`              topics and services carried between two networks
`terminal`           command lines, keys and text of terminals
`testing`            a domain, a filled buffer and waiting, for users' tests
`tf`                 the transform buffer, the listener that fills it, and its diagrams
`trajectory`         poses over time: sampled, in files, compared
`urdf`               robots: a parser of URDF and forward kinematics
`viewing`            `show`, which opens the 3D view of turtlewire-view
`wake_up`            waits of the main thread that signals can interrupt
`web`                a small HTTP and WebSocket server for this machine's browsers
`wire`               the middleware: bytes, QoS, names and the graph
`wording`            numbers with their nouns, and hints of the interface of a buffer
===================  =====================================================================
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from turtlewire import bag as bag
    from turtlewire import errors as errors
    from turtlewire import geometry as geometry
    from turtlewire import msg as msg
    from turtlewire import testing as testing
    from turtlewire import trajectory as trajectory
    from turtlewire import urdf as urdf
    from turtlewire import wire as wire
    from turtlewire.net import connect as connect
    from turtlewire.tf.buffer import Buffer as Buffer
    from turtlewire.tf.buffer import Transform as Transform
    from turtlewire.viewing import show as show

    __version__: str

__all__ = ["Buffer", "Transform", "__version__", "connect", "show"]

_HOMES = {
    "Buffer": "turtlewire.tf.buffer",
    "Transform": "turtlewire.tf.buffer",
    "connect": "turtlewire.net",
    "show": "turtlewire.viewing",
}
#: Modules that are attributes without a separate import.
_MODULES = {"bag", "errors", "geometry", "msg", "testing", "trajectory", "urdf", "wire"}


if not TYPE_CHECKING:  # a type checker would accept any name

    def __getattr__(name: str) -> object:
        # The core is loaded when it is first used: `import turtlewire.msg` and its like stay light.
        value: object
        if name == "__version__":
            value = _version()
        elif name in _HOMES:
            value = getattr(import_module(_HOMES[name]), name)
        elif name in _MODULES:
            return import_module(f"turtlewire.{name}")
        else:
            raise AttributeError(f"module 'turtlewire' has no attribute {name!r}")
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    return sorted(__all__)


def _version() -> str:
    from importlib.metadata import version

    return version("turtlewire")
