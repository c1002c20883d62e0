"""`turtlewire.show`: a viewer for a buffer, a robot, a connection, a bag or the network."""

from __future__ import annotations

import contextlib
import errno
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING

from turtlewire.bag import Bag
from turtlewire.net import Connection
from turtlewire.tf.buffer import Buffer
from turtlewire.trajectory import Trajectory
from turtlewire.urdf import Robot
from turtlewire.urdf.robot import is_xml
from turtlewire.web.desktop import open_browser
from turtlewire_view.bag_source import BagSource
from turtlewire_view.buffer_source import BufferSource, RobotSource
from turtlewire_view.live import LiveSource
from turtlewire_view.notebook import find_frame
from turtlewire_view.package_folders import PackageFolders
from turtlewire_view.robots import find_robot
from turtlewire_view.rviz_file import load_rviz
from turtlewire_view.viewer import Viewer

if TYPE_CHECKING:
    from turtlewire.urdf.robot import Positions
    from turtlewire_view.source import Source

__all__ = ["show"]

_LAST_PORT = 65535


def show(
    what: Buffer | Robot | Connection | str | os.PathLike[str] | None,
    *,
    positions: Positions | None,
    fixed_frame: str,
    config: str | os.PathLike[str] | None,
    port: int | None,
    lan: bool,
    proxy: str | None,
    packages: Mapping[str, str | os.PathLike[str]] | None,
) -> Viewer:
    """Show it; see `turtlewire.show`."""
    if not isinstance(fixed_frame, str):
        raise TypeError(f"fixed_frame must be str, not {type(fixed_frame).__name__}")
    if port is not None and not isinstance(port, int):
        raise TypeError(f"port must be int, not {type(port).__name__}")
    if port is not None and not 0 <= port <= _LAST_PORT:
        raise ValueError(f"port is {port}; ports have numbers from 0 to {_LAST_PORT}")
    saved = None if config is None else load_rviz(config)
    frame = find_frame(proxy)
    if lan and frame is not None and frame.proxied:
        raise ValueError(
            "lan is True, but the notebook's proxy reaches the view on this computer: leave out lan"
        )
    with contextlib.ExitStack() as stack:
        source, folders = _source(what, positions, _named(packages or {}))
        stack.callback(source.close)
        viewer = Viewer(
            source,
            fixed_frame,
            port=port,
            lan=lan,
            saved=saved,
            frame=frame,
            packages=folders,
        )
        stack.pop_all()
    if frame is None:
        open_browser(viewer.url)
    return viewer


def _source(
    what: Buffer | Robot | Connection | str | os.PathLike[str] | None,
    positions: Positions | None,
    named: Mapping[str, str],
) -> tuple[Source, PackageFolders]:
    if is_xml(what):
        raise ValueError("show accepts a path, not XML; for XML, pass Robot.from_xml(text)")
    packages = PackageFolders(named)
    if isinstance(what, (str, bytes, os.PathLike)):
        what = os.fsdecode(what)
        if (found := find_robot(what, named)) is not None:
            what, packages = found
    if isinstance(what, Robot):
        return RobotSource(what, {} if positions is None else positions), packages
    if positions is not None:
        raise TypeError(f"`positions` are those of a robot's joints; got {type(what).__name__}")
    if what is None:
        return LiveSource(), packages
    if isinstance(what, str):
        return BagSource(what), packages
    if isinstance(what, Connection):
        return LiveSource(what._context), packages
    if isinstance(what, Buffer):
        return BufferSource(what, "buffer"), packages
    raise _unknown(what)


def _named(packages: Mapping[str, str | os.PathLike[str]]) -> dict[str, str]:
    """Return the folders of packages as str.

    Raises:
        NotADirectoryError: A folder does not exist.
    """
    named = {name: os.fspath(folder) for name, folder in packages.items()}
    for name, folder in named.items():
        if not os.path.isdir(folder):
            text = f"the folder of the package {name!r} does not exist"
            raise NotADirectoryError(errno.ENOTDIR, text, folder)
    return named


def _unknown(what: object) -> TypeError:
    """Return the error for something that cannot be shown."""
    given, advice = type(what).__name__, ""
    if isinstance(what, type):
        given = f"the class {what.__name__}"
    elif isinstance(what, Bag):
        advice = "; pass its path"
    elif isinstance(what, Trajectory):
        advice = "; its plot() draws it"
    return TypeError(
        "show accepts a Buffer, a Robot, a Connection, the path of a bag or of a .urdf file, the "
        f"name of a robot, or None for the network; got {given}{advice}"
    )
