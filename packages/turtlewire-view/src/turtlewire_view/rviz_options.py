"""Maps the options of RViz's displays, and their values, to the page's options."""

from __future__ import annotations

from typing import Any

from turtlewire_view.displays.options import option_table
from turtlewire_view.rviz_values import (
    RvizOption,
    choice,
    color,
    flag,
    number,
    read_absolute,
    read_joints,
    read_links,
    read_namespaces,
    read_text,
    text,
    whole,
    write_joints,
    write_links,
    write_namespaces,
)

__all__ = ["CLASSES", "class_for", "from_rviz", "to_rviz"]

_NAMESPACE = "Interactive Markers Namespace"

_ALPHA = number("alpha", "Alpha")
_POINTS = (
    _ALPHA,
    number("size", "Size (Pixels)"),
    number("size_metres", "Size (m)"),
    choice("style", "Style", {"Points": "points", "Squares": "squares",
                               "Flat Squares": "flat squares", "Spheres": "spheres",
                               "Boxes": "boxes", "Tiles": "tiles"}),
    number("decay_time", "Decay Time"),
    choice("color", "Color Transformer", {"Intensity": "intensity", "RGB8": "rgb",
                                           "RGBF32": "rgbf32", "AxisColor": "axis",
                                           "FlatColor": "flat"}),
    text("channel", "Channel Name"),
    choice("axis", "Axis", {"Z": "z", "X": "x", "Y": "y"}),
    color("flat_color", "Color"),
    flag("rainbow", "Use rainbow"),
    flag("invert_rainbow", "Invert Rainbow"),
    flag("autocompute_bounds", "Autocompute Intensity Bounds"),
    number("min", "Min Intensity"),
    number("max", "Max Intensity"),
    color("min_color", "Min Color"),
    color("max_color", "Max Color"),
    flag("autocompute_axis", "Autocompute Value Bounds/Value"),
    number("axis_min", "Autocompute Value Bounds/Min Value"),
    number("axis_max", "Autocompute Value Bounds/Max Value"),
    flag("axis_in_fixed_frame", "Use Fixed Frame"),
)  # fmt: skip
_SHAPES = {"Arrow": "arrow", "Axes": "axes"}
_POSE = (
    choice("shape", "Shape", _SHAPES),
    color("color", "Color"),
    _ALPHA,
    number("length", "Shaft Length"),
)
_COVARIANCE = flag("show_covariance", "Covariance/Value")

_NAMESPACES = (RvizOption("namespaces", "Namespaces", read_namespaces, write_namespaces),)

_IMAGE = (
    flag("normalize_range", "Normalize Range"),
    number("min", "Min Value"),
    number("max", "Max Value"),
)

_MEASUREMENT = (
    _ALPHA,
    number("size", "Size (m)"),
    flag("usual_bounds", "Autocompute Intensity Bounds"),
    number("min", "Min Intensity"),
    number("max", "Max Intensity"),
    flag("rainbow", "Use rainbow"),
    flag("invert_rainbow", "Invert Rainbow"),
    color("min_color", "Min Color"),
    color("max_color", "Max Color"),
)


def _twist_or_wrench(straight: str, turning: str) -> tuple[RvizOption, ...]:
    """``straight`` and ``turning``: RViz's words for the two vectors."""
    return (
        color("linear_color", f"{straight} Color"),
        color("angular_color", f"{turning} Color"),
        _ALPHA,
        number("linear_scale", f"{straight} Arrow Scale"),
        number("angular_scale", f"{turning} Arrow Scale"),
        number("width", "Arrow Width"),
        whole("history_length", "History Length"),
        flag("hide_small_values", "Hide Small Values"),
    )


#: RViz's display to the page's kind and its options.
CLASSES: dict[str, tuple[str, tuple[RvizOption, ...]]] = {
    "RobotModel": (
        "robot_model",
        (
            flag("visual", "Visual Enabled"),
            flag("collision", "Collision Enabled"),
            _ALPHA,
            text("tf_prefix", "TF Prefix"),
            choice("source", "Description Source", {"Topic": "topic", "File": "file",
                                                     "Parameter": "parameter"}),
            text("description_file", "Description File"),
            text("node", "Description Parameter/Node"),
            text("parameter", "Description Parameter/Name"),
            flag("mass", "Mass Properties/Mass"),
            flag("inertia", "Mass Properties/Inertia"),
            RvizOption("links", "Links", read_links, write_links),
        ),
    ),
    "PointCloud2": ("point_cloud", _POINTS),
    "DepthCloud": (
        "depth_cloud",
        (
            text("color_topic", "Color Image Topic"),
            flag("auto_size", "Auto Size/Value"),
            number("auto_size_factor", "Auto Size/Auto Size Factor"),
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
            flag("show_descriptions", "Show Descriptions"),
            flag("show_axes", "Show Axes"),
            flag("show_visual_aids", "Show Visual Aids"),
            flag("transparency", "Enable Transparency"),
        ),
    ),
    "Map": (
        "occupancy_grid",
        (
            _ALPHA,
            choice("color_scheme", "Color Scheme", {"map": "map", "costmap": "costmap",
                                                     "raw": "raw"}),
            flag("draw_behind", "Draw Behind"),
            flag("use_timestamp", "Use Timestamp"),
        ),
    ),
    "Path": (
        "path",
        (
            color("color", "Color"),
            number("width", "Line Width"),
            _ALPHA,
            choice("pose_style", "Pose Style", {"None": "none", "Axes": "axes",
                                                 "Arrows": "arrows"}),
            whole("buffer_length", "Buffer Length"),
        ),
    ),
    "Odometry": (
        "odometry",
        (
            choice("shape", "Shape/Value", _SHAPES),
            color("color", "Shape/Color"),
            number("alpha", "Shape/Alpha"),
            number("length", "Shape/Shaft Length"),
            whole("keep", "Keep"),
            number("position_tolerance", "Position Tolerance"),
            number("angle_tolerance", "Angle Tolerance"),
            _COVARIANCE,
        ),
    ),
    "Pose": ("pose", _POSE),
    "PoseWithCovariance": ("pose", (*_POSE, _COVARIANCE)),
    "PoseArray": (
        "pose_array",
        (
            choice("shape", "Shape", {"Arrow (Flat)": "arrow", "Arrow (3D)": "arrow",
                                       "Axes": "axes"}),
            color("color", "Color"),
            _ALPHA,
            number("length", "Arrow Length"),
        ),
    ),
    "Polygon": ("polygon", (color("color", "Color"), _ALPHA)),
    "PointStamped": (
        "point",
        (
            number("radius", "Radius"),
            color("color", "Color"),
            _ALPHA,
            whole("history_length", "History Length"),
        ),
    ),
    "Range": ("range", (color("color", "Color"), _ALPHA)),
    "GridCells": ("grid_cells", (color("color", "Color"), _ALPHA)),
    "CameraInfo": (
        "camera_info",
        (
            number("far", "Far clip"),
            flag("show_polygons", "Show polygons"),
            color("color", "Color"),
            _ALPHA,
            flag("show_edges", "Show edges"),
            color("edge_color", "Edge color"),
        ),
    ),
    "Effort": (
        "effort",
        (
            _ALPHA,
            number("width", "Width"),
            number("scale", "Scale"),
            whole("history_length", "History Length"),
            RvizOption("description_topic", "Robot Description", read_absolute, read_text),
            text("tf_prefix", "TF Prefix"),
            RvizOption("joints", "Joints", read_joints, write_joints),
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
            choice("rendering", "Image Rendering",
                    {"background and overlay": "background and overlay",
                     "background": "background", "overlay": "overlay"}),
            number("alpha", "Overlay Alpha"),
            number("zoom", "Zoom Factor"),
            number("far", "Far Plane Distance"),
            flag("show_frames", "Visibility/TF"),
            flag("show_grid", "Visibility/Grid"),
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
    if kind == "effort":
        topic = topic or "/joint_states"
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
