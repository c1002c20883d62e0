"""The 3D view: a page that shows live frames or the frames of a bag, with sensor data.

::

    from turtlewire_view import LiveSource, Viewer

    viewer = Viewer(LiveSource())
    print(viewer.url)

==================  =============================================================================
module              contents
==================  =============================================================================
`viewer`            `Viewer`: serves the page, with one thread for updates and one for displays
`session`           one page: its requests, and the data that it has not received yet
`source`            `Source`, `Timeline`: the origin of frames and messages, and their time
`live`              `LiveSource`: the network
`bag_source`        `BagSource`: a bag with its own time
`buffer_source`     `BufferSource`, `RobotSource`: a buffer of the program; a robot with joints
`robots`            the robot of a path or name, and its joints that pages move
`service_watch`     calls a service when its server appears; reads a parameter of a node
`frames`            `FrameScene`: all poses in one frame, at one time, as one array; their reference
`tree`              the rows of the tree; the pose of one frame in another, also as a sentence
`display_feed`      a display of a page: waits for transforms, makes packets
`displays`          the drawing of each type of message
`meshes`            meshes of packages: addresses to URLs, URLs to files
`package_folders`   finds packages: named by the user, around a URDF, in the ament index
`page_commands`     the commands of the page
`page_requests`     publish with a tool, give feedback on interactive markers, save a view
`rviz_file`         views of ``.rviz`` files, with their camera
`rviz_writing`      views as ``.rviz`` files
`rviz_options`      options of RViz's displays and of the page's
`rviz_values`       their values in both
`showing`           ``turtlewire.show``
`notebook`          the view in the output of a cell of Jupyter
`view_command`      ``turtlewire view``
`graph`             the page of nodes and topics, and its files
`graph_command`     ``turtlewire graph``
`foxglove`          the server of Foxglove's protocol: topics for Foxglove and Lichtblick
`foxglove_command`  ``turtlewire foxglove``
==================  =============================================================================
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from turtlewire_view.bag_source import BagSource
    from turtlewire_view.buffer_source import BufferSource
    from turtlewire_view.live import LiveSource
    from turtlewire_view.viewer import Viewer

#: Loaded at first use: parsing a command line needs none of them, and a live view needs no bag.
_MODULES = {
    "BagSource": "bag_source",
    "BufferSource": "buffer_source",
    "LiveSource": "live",
    "Viewer": "viewer",
}

__all__ = ["BagSource", "BufferSource", "LiveSource", "Viewer"]


def __getattr__(name: str) -> object:
    if name not in _MODULES:
        raise AttributeError(f"module 'turtlewire_view' has no attribute {name!r}")
    value = globals()[name] = getattr(import_module(f"turtlewire_view.{_MODULES[name]}"), name)
    return value
