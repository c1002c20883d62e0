"""Which option of RViz's displays is which of the page's, and how their values are written."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["CLASSES", "class_for", "from_rviz", "to_rviz"]

_COLOR = re.compile(r"\s*(\d{1,3})\s*;\s*(\d{1,3})\s*;\s*(\d{1,3})\s*")
_OUR_COLOR = re.compile("#[0-9a-fA-F]{6}")


class _Option(NamedTuple):
    """An option: its name here, its path in RViz (names joined by ``/``), and how values map."""

    ours: str
    theirs: str
    read: Callable[[object], object]
    write: Callable[[object], object]


def _number(ours: str, theirs: str) -> _Option:
    return _Option(ours, theirs, _read_number, _read_number)


def _whole(ours: str, theirs: str) -> _Option:
    return _Option(ours, theirs, _read_number, _write_whole)


def _flag(ours: str, theirs: str) -> _Option:
    return _Option(ours, theirs, _read_flag, _read_flag)


def _text(ours: str, theirs: str) -> _Option:
    return _Option(ours, theirs, _read_text, _read_text)


def _color(ours: str, theirs: str) -> _Option:
    return _Option(ours, theirs, _read_color, _write_color)


def _choice(ours: str, theirs: str, names: dict[str, str]) -> _Option:
    """``names``: RViz's name to ours; the first of several is written."""
    back = {mine: name for name, mine in reversed(names.items())}
    return _Option(
        ours, theirs, lambda value: _among(names, value), lambda value: _among(back, value)
    )


def _among(names: dict[str, str], value: object) -> object:
    return names.get(value) if isinstance(value, str) else None


def _read_number(value: object) -> object:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return None
    return value if abs(value) < 1e12 and math.isfinite(value) else None


def _read_color(value: object) -> str | None:
    match = _COLOR.fullmatch(value) if isinstance(value, str) else None
    if match is None:
        return None
    return "#" + "".join(f"{min(255, int(part)):02x}" for part in match.groups())


def _read_flag(value: object) -> object:
    return value if isinstance(value, bool) else None


def _read_text(value: object) -> object:
    return value if isinstance(value, str) else None


def _write_whole(value: object) -> object:
    number = _read_number(value)
    return round(number) if isinstance(number, (int, float)) else None


def _write_color(value: object) -> str | None:
    if not isinstance(value, str) or not _OUR_COLOR.fullmatch(value):
        return None
    return "; ".join(str(int(value[at : at + 2], 16)) for at in (1, 3, 5))


_ALPHA = _number("alpha", "Alpha")
_POINTS = (
    _ALPHA,
    _number("size", "Size (Pixels)"),
    _number("size_metres", "Size (m)"),
    _choice("style", "Style", {"Flat Squares": "squares", "Points": "squares",
                               "Squares": "squares", "Boxes": "squares", "Tiles": "squares",
                               "Spheres": "discs"}),
    _choice("color", "Color Transformer", {"Intensity": "intensity", "RGB8": "rgb",
                                           "RGBF32": "rgb", "AxisColor": "axis",
                                           "FlatColor": "flat"}),
    _text("channel", "Channel Name"),
    _choice("axis", "Axis", {"Z": "z", "X": "x", "Y": "y"}),
    _color("flat_color", "Color"),
    _flag("rainbow", "Use rainbow"),
    _flag("invert_rainbow", "Invert Rainbow"),
    _flag("autocompute_bounds", "Autocompute Intensity Bounds"),
    _number("min", "Min Intensity"),
    _number("max", "Max Intensity"),
)  # fmt: skip
_SHAPES = {"Arrow": "arrow", "Axes": "axes"}
_POSE = (
    _choice("shape", "Shape", _SHAPES),
    _color("color", "Color"),
    _ALPHA,
    _number("length", "Shaft Length"),
)
_COVARIANCE = _flag("show_covariance", "Covariance/Value")

#: RViz's display to the page's kind and its options.
CLASSES: dict[str, tuple[str, tuple[_Option, ...]]] = {
    "RobotModel": (
        "robot_model",
        (
            _flag("visual", "Visual Enabled"),
            _flag("collision", "Collision Enabled"),
            _ALPHA,
            _text("tf_prefix", "TF Prefix"),
        ),
    ),
    "PointCloud2": ("point_cloud", _POINTS),
    "LaserScan": ("laser_scan", _POINTS),
    "Marker": ("marker", ()),
    "MarkerArray": ("marker", ()),
    "Map": (
        "occupancy_grid",
        (
            _ALPHA,
            _choice("color_scheme", "Color Scheme", {"map": "map", "costmap": "costmap",
                                                     "raw": "raw"}),
            _flag("draw_behind", "Draw Behind"),
        ),
    ),
    "Path": (
        "path",
        (
            _color("color", "Color"),
            _number("width", "Line Width"),
            _ALPHA,
            _choice("pose_style", "Pose Style", {"None": "none", "Axes": "axes",
                                                 "Arrows": "arrows"}),
            _whole("buffer_length", "Buffer Length"),
        ),
    ),
    "Odometry": (
        "odometry",
        (
            _choice("shape", "Shape/Value", _SHAPES),
            _color("color", "Shape/Color"),
            _number("alpha", "Shape/Alpha"),
            _number("length", "Shape/Shaft Length"),
            _whole("keep", "Keep"),
            _number("position_tolerance", "Position Tolerance"),
            _number("angle_tolerance", "Angle Tolerance"),
            _COVARIANCE,
        ),
    ),
    "Pose": ("pose", _POSE),
    "PoseWithCovariance": ("pose", (*_POSE, _COVARIANCE)),
    "PoseArray": (
        "pose_array",
        (
            _choice("shape", "Shape", {"Arrow (Flat)": "arrow", "Arrow (3D)": "arrow",
                                       "Axes": "axes"}),
            _color("color", "Color"),
            _ALPHA,
            _number("length", "Arrow Length"),
        ),
    ),
    "Polygon": ("polygon", (_color("color", "Color"), _ALPHA)),
    "PointStamped": (
        "point",
        (
            _number("radius", "Radius"),
            _color("color", "Color"),
            _ALPHA,
            _whole("history_length", "History Length"),
        ),
    ),
    "Range": ("range", (_color("color", "Color"), _ALPHA)),
    "Image": (
        "image",
        (
            _flag("normalize_range", "Normalize Range"),
            _number("min", "Min Value"),
            _number("max", "Max Value"),
        ),
    ),
}  # fmt: skip
#: Of kinds that several of RViz's displays have: which one shows a type.
_BY_TYPE = {
    "visualization_msgs/msg/MarkerArray": "MarkerArray",
    "visualization_msgs/msg/Marker": "Marker",
    "geometry_msgs/msg/PoseWithCovarianceStamped": "PoseWithCovariance",
}


def class_for(kind: str, type_name: str) -> str | None:
    """RViz's display for a kind of the page's and a message type; None if it has none."""
    by_type = _BY_TYPE.get(type_name)
    if by_type is not None and CLASSES[by_type][0] == kind:
        return by_type
    return next((name for name, (each, _) in CLASSES.items() if each == kind), None)


def from_rviz(name: str, properties: dict[str, Any]) -> tuple[str, dict[str, object]]:
    """Topic and options of a display of RViz; values that make no sense are left out."""
    kind, options = CLASSES[name]
    found: dict[str, object] = {}
    for option in options:
        value = option.read(_at(properties, option.theirs))
        if value is not None:
            found[option.ours] = value
    if kind in {"point_cloud", "laser_scan"} and properties.get("Style") == "Points":
        found["size_metres"] = 0  # this style alone is as wide as its pixels say
    if name in _BY_TYPE.values():
        found["message_type"] = next(each for each, shows in _BY_TYPE.items() if shows == name)
    if properties.get("Description Source") == "File":
        file = _read_text(properties.get("Description File"))
        found |= {"description_file": file} if file else {}
    topic = _topic(properties)
    return topic or ("/robot_description" if kind == "robot_model" else ""), found


def to_rviz(name: str, topic: str, options: dict[str, object]) -> dict[str, Any]:
    """The properties of a display of RViz."""
    kind, known = CLASSES[name]
    latched = kind in {"robot_model", "occupancy_grid"}
    address = {
        "Depth": 5,
        "Durability Policy": "Transient Local" if latched else "Volatile",
        "History Policy": "Keep Last",
        "Reliability Policy": "Reliable" if latched else "Best Effort",
        "Value": topic,
    }
    properties: dict[str, Any] = {}
    if kind == "robot_model":
        file = _read_text(options.get("description_file")) or ""
        source = "File" if file else "Topic"
        properties = {
            "Description File": file,
            "Description Source": source,
            "Description Topic": address,
        }
    else:
        properties = {"Topic": address}
    for option in known:
        value = option.write(options.get(option.ours))
        if value is not None:
            _put(properties, option.theirs, value)
    if kind in {"point_cloud", "laser_scan"} and not options.get("size_metres"):
        properties["Style"] = "Points"
        properties.pop("Size (m)", None)
    return properties


def _topic(properties: dict[str, Any]) -> str:
    """The topic, which ROS 1's files give as a text and ROS 2's with its QoS."""
    for name in ("Topic", "Description Topic", "Marker Topic", "Image Topic"):
        value = properties.get(name)
        if isinstance(value, dict):
            value = value.get("Value")
        if isinstance(value, str) and value:
            return value
    return ""


def _at(properties: dict[str, Any], path: str) -> object:
    value: object = properties
    for name in path.split("/"):
        value = value.get(name) if isinstance(value, dict) else None
    return value


def _put(properties: dict[str, Any], path: str, value: object) -> None:
    *groups, last = path.split("/")
    for name in groups:
        properties = properties.setdefault(name, {})
    properties[last] = value
