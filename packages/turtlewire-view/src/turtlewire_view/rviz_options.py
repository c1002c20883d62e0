"""Maps the options of RViz's displays, and their values, to the page's options."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire_view.displays.options import option_table

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire_view.displays.options import Option

__all__ = ["CLASSES", "class_for", "from_rviz", "to_rviz"]

_COLOR = re.compile(r"\s*(\d{1,3})\s*;\s*(\d{1,3})\s*;\s*(\d{1,3})\s*")
_OUR_COLOR = re.compile("#[0-9a-fA-F]{6}")


_NAMESPACE = "Interactive Markers Namespace"


class _Option(NamedTuple):
    """An option: its name here, its path in RViz (names joined by ``/``), and how values map."""

    ours: str
    theirs: str
    read: Callable[[object], object]
    write: Callable[[object], object]
    names: tuple[str, ...] = ()

    def wanted(self, entry: Option) -> str:
        """Describe the values that the page supports of RViz's option."""
        if entry.type == "color":
            return "a colour as '255; 255; 255'"
        return f"one of {', '.join(self.names)}" if self.names else entry.wanted()


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
        ours,
        theirs,
        lambda value: _among(names, value),
        lambda value: _among(back, value),
        tuple(names),
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


def _read_namespaces(value: object) -> object:
    if not isinstance(value, dict):
        return None
    return {str(name): {"shown": on} for name, on in value.items() if isinstance(on, bool)}


def _write_namespaces(value: object) -> object:
    items = _items(value)
    return {name: item.get("shown", True) for name, item in items.items()} or None


def _read_links(value: object) -> object:
    """Read each link's visibility and alpha."""
    if not isinstance(value, dict):
        return None
    links = {str(name): each for name, each in value.items() if isinstance(each, dict)}
    return {
        name: {"shown": each.get("Value") is not False, "alpha": alpha}
        for name, each in links.items()
        if (alpha := _read_number(each.get("Alpha", 1))) is not None
    }


def _write_links(value: object) -> object:
    items = _items(value)
    return {
        name: {"Alpha": item.get("alpha", 1), "Value": item.get("shown", True)}
        for name, item in items.items()
    } or None


def _items(value: object) -> dict[str, dict[str, Any]]:
    if not isinstance(value, dict):
        return {}
    return {str(name): item for name, item in value.items() if isinstance(item, dict)}


_ALPHA = _number("alpha", "Alpha")
_POINTS = (
    _ALPHA,
    _number("size", "Size (Pixels)"),
    _number("size_metres", "Size (m)"),
    _choice("style", "Style", {"Points": "points", "Squares": "squares",
                               "Flat Squares": "flat squares", "Spheres": "spheres",
                               "Boxes": "boxes", "Tiles": "tiles"}),
    _number("decay_time", "Decay Time"),
    _choice("color", "Color Transformer", {"Intensity": "intensity", "RGB8": "rgb",
                                           "RGBF32": "rgbf32", "AxisColor": "axis",
                                           "FlatColor": "flat"}),
    _text("channel", "Channel Name"),
    _choice("axis", "Axis", {"Z": "z", "X": "x", "Y": "y"}),
    _color("flat_color", "Color"),
    _flag("rainbow", "Use rainbow"),
    _flag("invert_rainbow", "Invert Rainbow"),
    _flag("autocompute_bounds", "Autocompute Intensity Bounds"),
    _number("min", "Min Intensity"),
    _number("max", "Max Intensity"),
    _color("min_color", "Min Color"),
    _color("max_color", "Max Color"),
    _flag("autocompute_axis", "Autocompute Value Bounds/Value"),
    _number("axis_min", "Autocompute Value Bounds/Min Value"),
    _number("axis_max", "Autocompute Value Bounds/Max Value"),
    _flag("axis_in_fixed_frame", "Use Fixed Frame"),
)  # fmt: skip
_SHAPES = {"Arrow": "arrow", "Axes": "axes"}
_POSE = (
    _choice("shape", "Shape", _SHAPES),
    _color("color", "Color"),
    _ALPHA,
    _number("length", "Shaft Length"),
)
_COVARIANCE = _flag("show_covariance", "Covariance/Value")

_NAMESPACES = (_Option("namespaces", "Namespaces", _read_namespaces, _write_namespaces),)

_IMAGE = (
    _flag("normalize_range", "Normalize Range"),
    _number("min", "Min Value"),
    _number("max", "Max Value"),
)

_MEASUREMENT = (
    _ALPHA,
    _number("size", "Size (m)"),
    _flag("usual_bounds", "Autocompute Intensity Bounds"),
    _number("min", "Min Intensity"),
    _number("max", "Max Intensity"),
    _flag("rainbow", "Use rainbow"),
    _flag("invert_rainbow", "Invert Rainbow"),
    _color("min_color", "Min Color"),
    _color("max_color", "Max Color"),
)


def _twist_or_wrench(straight: str, turning: str) -> tuple[_Option, ...]:
    """``straight`` and ``turning``: RViz's words for the two vectors."""
    return (
        _color("linear_color", f"{straight} Color"),
        _color("angular_color", f"{turning} Color"),
        _ALPHA,
        _number("linear_scale", f"{straight} Arrow Scale"),
        _number("angular_scale", f"{turning} Arrow Scale"),
        _number("width", "Arrow Width"),
        _whole("history_length", "History Length"),
        _flag("hide_small_values", "Hide Small Values"),
    )


#: RViz's display to the page's kind and its options.
CLASSES: dict[str, tuple[str, tuple[_Option, ...]]] = {
    "RobotModel": (
        "robot_model",
        (
            _flag("visual", "Visual Enabled"),
            _flag("collision", "Collision Enabled"),
            _ALPHA,
            _text("tf_prefix", "TF Prefix"),
            _choice("source", "Description Source", {"Topic": "topic", "File": "file",
                                                     "Parameter": "parameter"}),
            _text("description_file", "Description File"),
            _text("node", "Description Parameter/Node"),
            _text("parameter", "Description Parameter/Name"),
            _flag("mass", "Mass Properties/Mass"),
            _flag("inertia", "Mass Properties/Inertia"),
            _Option("links", "Links", _read_links, _write_links),
        ),
    ),
    "PointCloud2": ("point_cloud", _POINTS),
    "DepthCloud": (
        "depth_cloud",
        (
            _text("color_topic", "Color Image Topic"),
            _flag("auto_size", "Auto Size/Value"),
            _number("auto_size_factor", "Auto Size/Auto Size Factor"),
            *_POINTS,
        ),
    ),
    "PointCloud": ("point_cloud", _POINTS),
    "LaserScan": ("laser_scan", _POINTS),
    "Marker": ("marker", _NAMESPACES),
    "MarkerArray": ("marker", _NAMESPACES),
    "InteractiveMarkers": (
        "interactive_markers",
        (
            _flag("show_descriptions", "Show Descriptions"),
            _flag("show_axes", "Show Axes"),
            _flag("show_visual_aids", "Show Visual Aids"),
            _flag("transparency", "Enable Transparency"),
        ),
    ),
    "Map": (
        "occupancy_grid",
        (
            _ALPHA,
            _choice("color_scheme", "Color Scheme", {"map": "map", "costmap": "costmap",
                                                     "raw": "raw"}),
            _flag("draw_behind", "Draw Behind"),
            _flag("use_timestamp", "Use Timestamp"),
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
    "GridCells": ("grid_cells", (_color("color", "Color"), _ALPHA)),
    "CameraInfo": (
        "camera_info",
        (
            _number("far", "Far clip"),
            _flag("show_polygons", "Show polygons"),
            _color("color", "Color"),
            _ALPHA,
            _flag("show_edges", "Show edges"),
            _color("edge_color", "Edge color"),
        ),
    ),
    "TwistStamped": ("twist_or_wrench", _twist_or_wrench("Linear", "Angular")),
    "AccelStamped": ("twist_or_wrench", _twist_or_wrench("Linear", "Angular")),
    "Wrench": ("twist_or_wrench", _twist_or_wrench("Force", "Torque")),
    "Temperature": ("measurement", _MEASUREMENT),
    "RelativeHumidity": ("measurement", _MEASUREMENT),
    "FluidPressure": ("measurement", _MEASUREMENT),
    "Illuminance": ("measurement", _MEASUREMENT),
    "Image": ("image", _IMAGE),
    "Camera": (
        "camera",
        (
            _choice("rendering", "Image Rendering",
                    {"background and overlay": "background and overlay",
                     "background": "background", "overlay": "overlay"}),
            _number("alpha", "Overlay Alpha"),
            _number("zoom", "Zoom Factor"),
            _number("far", "Far Plane Distance"),
            _flag("show_frames", "Visibility/TF"),
            _flag("show_grid", "Visibility/Grid"),
            *_IMAGE,
        ),
    ),
}  # fmt: skip
#: Of kinds that several of RViz's displays have: which one shows a type.
_BY_TYPE = {
    "visualization_msgs/msg/MarkerArray": "MarkerArray",
    "visualization_msgs/msg/Marker": "Marker",
    "geometry_msgs/msg/PoseWithCovarianceStamped": "PoseWithCovariance",
    "sensor_msgs/msg/PointCloud": "PointCloud",
    "geometry_msgs/msg/TwistStamped": "TwistStamped",
    "geometry_msgs/msg/AccelStamped": "AccelStamped",
    "geometry_msgs/msg/WrenchStamped": "Wrench",
    "sensor_msgs/msg/Temperature": "Temperature",
    "sensor_msgs/msg/RelativeHumidity": "RelativeHumidity",
    "sensor_msgs/msg/FluidPressure": "FluidPressure",
    "sensor_msgs/msg/Illuminance": "Illuminance",
}


def class_for(kind: str, type_name: str) -> str | None:
    """RViz's display for a kind of the page's and a message type; None if it has none."""
    by_type = _BY_TYPE.get(type_name)
    if by_type is not None and CLASSES[by_type][0] == kind:
        return by_type
    return next((name for name, (each, _) in CLASSES.items() if each == kind), None)


def from_rviz(name: str, properties: dict[str, Any]) -> tuple[str, dict[str, object], list[str]]:
    """Topic and options of a display of RViz, and a line for each value that is refused."""
    kind, options = CLASSES[name]
    found: dict[str, object] = {}
    problems = []
    table = option_table(kind)
    for option in options:
        given = _at(properties, option.theirs)
        value = option.read(given)
        entry = table.get(option.ours)  # a scan has no colours, for example
        if entry is None or given is None or given == "":
            continue
        if value is not None and entry.accepts(value):
            found[option.ours] = value
        else:
            problems.append(f"'{option.theirs}' must be {option.wanted(entry)}, got {given!r:.60}")
    if name in _BY_TYPE.values():
        found["message_type"] = next(each for each, shows in _BY_TYPE.items() if shows == name)
    topic = _topic(properties)
    if kind == "robot_model" and found.get("source", "topic") == "topic":
        topic = topic or "/robot_description"
    return topic, found, problems


def to_rviz(name: str, topic: str, options: dict[str, object]) -> dict[str, Any]:
    """Return the properties of a display of RViz."""
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
        properties = {"Description Topic": address, "Description File": ""}
    elif kind == "interactive_markers":
        properties = {_NAMESPACE: topic.removesuffix("/update")}
    elif kind == "depth_cloud":
        properties = {"Depth Map Topic": topic}
    else:
        properties = {"Topic": address}
    for option in known:
        value = option.write(options.get(option.ours))
        if value is not None:
            _put(properties, option.theirs, value)
    return properties


def _topic(properties: dict[str, Any]) -> str:
    """Return the topic, which ROS 1's files give as a text and ROS 2's with its QoS."""
    namespace = properties.get(_NAMESPACE)
    if isinstance(namespace, str) and namespace:
        return "/" + namespace.strip("/") + "/update"
    for name in (
        "Topic",
        "Description Topic",
        "Marker Topic",
        "Image Topic",
        "Depth Map Topic",
        "Update Topic",
    ):
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
