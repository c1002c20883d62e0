"""Markers that users move, and menus on them, in a 3D view such as RViz.

===========================  ==================================================
module                       contents
===========================  ==================================================
`interactive_marker_server`  `InteractiveMarkerServer`, which serves the markers
`menu_handler`               `MenuHandler`, a menu of one or more markers
===========================  ==================================================
"""

from interactive_markers.interactive_marker_server import InteractiveMarkerServer
from interactive_markers.menu_handler import MenuHandler

__all__ = ["InteractiveMarkerServer", "MenuHandler"]
