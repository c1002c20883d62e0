"""Views as .rviz files: RViz's own files are read, and what is written is read again."""

import contextlib
import json
from dataclasses import replace

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from turtlewire.web.commands import CommandError
from turtlewire_view.displays import display_types
from turtlewire_view.page_commands import READER, SaveView
from turtlewire_view.page_requests import message_of_tool, text_of_view
from turtlewire_view.rviz_file import RvizFileError, SavedDisplay, SavedView, read_rviz
from turtlewire_view.rviz_options import CLASSES, class_for
from turtlewire_view.rviz_writing import write_rviz

FILE = """
Panels:
  - Class: rviz_common/Displays
Visualization Manager:
  Class: ""
  Displays:
    - {Alpha: 0.5, Class: rviz_default_plugins/Grid, Enabled: false, Name: Grid}
    - Class: rviz_default_plugins/TF
      Enabled: true
      Frame Timeout: 15
      Show Arrows: false
      Show Axes: true
      Show Names: true
    - Alpha: 0.7
      Class: rviz_default_plugins/RobotModel
      Collision Enabled: true
      Description Source: Topic
      Description Topic: {Depth: 5, Durability Policy: Volatile, Value: /robot_description}
      Enabled: true
      TF Prefix: ""
      Visual Enabled: true
    - Class: rviz_common/Group
      Enabled: true
      Displays:
        - Class: rviz_default_plugins/LaserScan
          Color: 10; 20; 255
          Color Transformer: FlatColor
          Enabled: false
          Size (Pixels): 4
          Size (m): 0.05
          Style: Points
          Topic: {Value: /scan}
        - Class: rviz_default_plugins/Odometry
          Covariance: {Value: false}
          Keep: 7
          Shape: {Value: Axes, Color: 1; 2; 3}
          Topic: {Value: /odom}
    - {Class: rviz/Path, Color: 25; 255; 0, Topic: /plan, Line Width: .nan}
    - {Class: rviz_default_plugins/MarkerArray, Topic: {Value: /walls}}
    - {Class: rviz_imu_plugin/Imu}
  Global Options: {Background Color: 48; 48; 48, Fixed Frame: odom, Frame Rate: 30}
"""


def test_a_file_of_rviz_is_read():
    view = read_rviz(FILE)
    assert view.fixed == "odom"
    assert view.show == {"grid": False, "names": True, "axes": True, "arrows": False}
    assert view.unread == (
        "Unsupported displays: Imu. Invalid values, defaults used: "
        "Path: 'Line Width' must be a number from 0 to 1000, got nan"
    )
    robot, scan, odometry, path, walls = view.displays
    assert robot == SavedDisplay(
        "robot_model",
        "/robot_description",
        {"visual": True, "collision": True, "alpha": 0.7, "source": "topic"},
        place=3,
    )
    assert scan == SavedDisplay(
        "laser_scan",
        "/scan",
        {
            "size": 4,
            "size_metres": 0.05,
            "style": "points",
            "color": "flat",
            "flat_color": "#0a14ff",
        },
        visible=False,
        place=5,
    )
    assert odometry.options == {
        "keep": 7, "shape": "axes", "color": "#010203", "show_covariance": False
    }  # fmt: skip
    assert (path.topic, path.options) == ("/plan", {"color": "#19ff00"})
    assert walls.options == {"message_type": "visualization_msgs/msg/MarkerArray"}
    assert view.header()["displays"][1]["visible"] is False


#: Properties of displays in a file; kind, topic and options of each; what a saved file holds.
FILES = {
    "camera": (
        """
- Class: rviz_default_plugins/Camera
  Far Plane Distance: 30
  Image Rendering: background
  Overlay Alpha: 0.25
  Topic: {Value: /eye/image_raw, Depth: 9}
  Visibility: {Grid: false, TF: true, Value: true, Walls: true}
  Zoom Factor: 2
""",
        ["camera", "/eye/image_raw", {
            "rendering": "background", "alpha": 0.25, "zoom": 2, "far": 30, "show_grid": False,
            "show_frames": True,
        }],
        {"Visibility": {"Walls": True}, "Topic": {"Depth": 9}},
    ),
    "depth cloud": (
        """
- Alpha: 0.5
  Auto Size: {Auto Size Factor: 1.5, Value: true}
  Class: rviz_default_plugins/DepthCloud
  Color Image Topic: /eye/color
  Color Transformer: RGB8
  Color Transport Hint: raw
  Decay Time: 2
  Depth Map Topic: /eye/depth
  Occlusion Compensation: {Occlusion Time-Out: 30, Value: true}
  Queue Size: 5
  Style: Flat Squares
  Topic Filter: true
""",
        ["depth_cloud", "/eye/depth", {
            "alpha": 0.5, "auto_size": True, "auto_size_factor": 1.5, "color_topic": "/eye/color",
            "color": "rgb", "decay_time": 2, "style": "flat squares",
        }],
        {"Depth Map Topic": "/eye/depth", "Topic": None,
         "Occlusion Compensation": {"Occlusion Time-Out": 30, "Value": True}},
    ),
    "effort": (
        """
- Alpha: 0.5
  Class: rviz_default_plugins/Effort
  History Length: 3
  Joints: {All Enabled: true, elbow: {Value: false}, roll: true, slide: {Max Effort: 7}}
  Robot Description: arm_description
  Scale: 2
  TF Prefix: left
  Topic: {Value: /arm/joint_states}
  Width: 0.1
""",
        ["effort", "/arm/joint_states", {
            "alpha": 0.5, "history_length": 3, "description_topic": "/arm_description", "scale": 2,
            "tf_prefix": "left", "width": 0.1,
            "joints": {"elbow": {"shown": False}, "roll": {"shown": True},
                       "slide": {"shown": True, "max": 7}},
        }],
        {"Joints": {"All Enabled": True, "slide": {"Value": True, "Max Effort": 7}}},
    ),
    "effort by default": (
        "- {Class: rviz_default_plugins/Effort}", ["effort", "/joint_states", {}], {}
    ),
    "interactive markers": (
        """
- Class: rviz_default_plugins/InteractiveMarkers
  Enable Transparency: false
  Interactive Markers Namespace: /arm
  Show Axes: true
  Show Descriptions: false
  Show Visual Aids: true
""",
        ["interactive_markers", "/arm/update", {
            "transparency": False, "show_axes": True, "show_descriptions": False,
            "show_visual_aids": True,
        }],
        {"Interactive Markers Namespace": "/arm", "Topic": None},
    ),
    "interactive markers of ROS 1": (
        "- {Class: rviz/InteractiveMarkers, Update Topic: /old/update}",
        ["interactive_markers", "/old/update", {}],
        {},
    ),
}  # fmt: skip


def assert_holds(found, expected):
    for name, value in expected.items():
        if isinstance(value, dict):
            assert_holds(found[name], value)
        else:
            assert found.get(name) == value


@pytest.mark.parametrize(("text", "expected", "saved"), FILES.values(), ids=FILES)
def test_a_display_of_a_file(text, expected, saved):
    displays = yaml.safe_load(text)
    view = read_rviz(yaml.safe_dump({"Visualization Manager": {"Displays": displays}}))
    (display,) = view.displays
    assert [display.kind, display.topic, display.options] == expected
    assert view.unread == ""
    again = read_rviz(write_rviz(view, {}, view))
    assert again.displays == view.displays
    assert_holds(again.document["Visualization Manager"]["Displays"][0], saved)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("", "holds no properties"),
        ("- a", "holds no properties"),
        ("a: [", "the file is not YAML"),
        ("a: 1", "has no 'Visualization Manager'"),
        ("!!python/object/apply:os.system [echo]", "the file is not YAML"),
        ("\x00", "the file is not YAML"),
        ("x" * 2_000_000, "too many for a .rviz file"),
        ("[" * 100_000, "^the file is not YAML: nested too deeply$"),
    ],
)
def test_texts_that_are_no_view(text, why):
    with pytest.raises(RvizFileError, match=why):
        read_rviz(text)


PATHS = "Visualization Manager: {Displays: [{Class: rviz/Path, Alpha: &a 1, Line Width: *a}]}"


def bomb(first, rest):
    """Return nine lines that stand for a billion values."""
    lines = [f"a0: &a0 {first}"]
    for k in range(1, 10):
        references = ", ".join([f"*a{k - 1}"] * 10)
        lines.append(f"a{k}: &a{k} {rest.format(references)}")
    return "\n".join(
        [*lines, "Visualization Manager: {Displays: [{Class: rviz/Path, Alpha: *a9}]}"]
    )


@pytest.mark.parametrize("text", [PATHS, bomb("[]", "[{}]"), bomb("{x: 1}", "{{<<: [{}]}}")])
def test_aliases_are_refused(text):
    with pytest.raises(RvizFileError, match=r"^it has YAML aliases, such as \*name, which RViz"):
        read_rviz(text)


NONSENSE = st.recursive(
    st.none() | st.booleans() | st.floats() | st.text(max_size=5) | st.integers(),
    lambda each: (
        st.lists(each, max_size=3) | st.dictionaries(st.text(max_size=5), each, max_size=3)
    ),
    max_leaves=8,
)
FULL = """
Panels:
  - {Class: rviz_common/Displays, Splitter Ratio: 0.5}
Visualization Manager:
  Displays:
    - {Class: rviz_imu_plugin/Imu, Name: imu, Topic: {Value: /imu, Depth: 9}}
    - Class: rviz_common/Group
      Displays:
        - Class: rviz_default_plugins/LaserScan
          Decay Time: 2
          Selectable: true
          Topic:
            Depth: 7
            Durability Policy: Transient Local
            Filter size: 10
            History Policy: Keep All
            Reliability Policy: Reliable
            Value: /scan
        - {Class: rviz_default_plugins/Path, Topic: {Value: /plan}}
    - {Class: rviz_default_plugins/TF, Frames: {All Enabled: false, map: {Value: true}}}
  Global Options: {Background Color: 1; 2; 3, Fixed Frame: odom, Frame Rate: 10}
  Tools: [{Class: rviz_default_plugins/Select}]
  Views:
    Current: {Class: rviz_default_plugins/TopDownOrtho, Scale: 30, X: 1}
    Saved: ~
Window Geometry: {Height: 700}
"""


def test_unsupported_parts_are_written_back():
    before = yaml.safe_load(FULL)
    view = read_rviz(FULL)
    scan, path = view.displays
    changed = replace(scan, topic="/front", visible=False, options={**scan.options, "alpha": 0.5})
    new = SavedDisplay("polygon", "/area")
    after = yaml.safe_load(write_rviz(replace(view, displays=(changed, new)), {}, view))
    manager, former = after["Visualization Manager"], before["Visualization Manager"]
    for name in ("Views", "Tools", "Global Options"):
        assert manager[name] == former[name]
    assert {name: after[name] for name in ("Panels", "Window Geometry")} == {
        name: before[name] for name in ("Panels", "Window Geometry")
    }
    imu, group, frames, grid, polygon = manager["Displays"]
    assert imu == former["Displays"][0]
    (kept,) = group["Displays"]  # the path was removed in the page
    former_scan = former["Displays"][1]["Displays"][0]
    assert kept["Topic"] == {**former_scan["Topic"], "Value": "/front"}
    assert (kept["Selectable"], kept["Decay Time"], kept["Alpha"]) == (True, 2, 0.5)
    assert kept["Enabled"] is False
    assert frames["Frames"] == former["Displays"][2]["Frames"]
    assert grid["Class"].endswith("/Grid")
    assert polygon["Topic"]["Value"] == "/area"
    again = yaml.safe_load(write_rviz(replace(view, displays=(scan, path)), {}, view))
    assert [each.topic for each in read_rviz(yaml.safe_dump(again)).displays] == ["/scan", "/plan"]


@pytest.mark.parametrize(
    ("given", "why"),
    [
        ("Alpha: 2", "'Alpha' must be a number from 0 to 1, got 2"),
        ("Alpha: thick", "'Alpha' must be a number from 0 to 1, got 'thick'"),
        ("Style: Dots", "'Style' must be one of Points, Squares, Flat Squares, Spheres, Boxes, "),
        ("Color: red", "'Color' must be a colour as '255; 255; 255', got 'red'"),
        ("Use rainbow: 1", "'Use rainbow' must be true or false, got 1"),
        ("Decay Time: -1", "'Decay Time' must be a number from 0 to 3600, got -1"),
        (f"Decay Time: 1{400 * '0'}", "'Decay Time' must be a number from 0 to 3600, got inf"),
        (f"Decay Time: -0x{4000 * 'f'}", "'Decay Time' must be a number from 0 to 3600, got -inf"),
    ],
)
def test_wrong_values_of_a_file_are_named(given, why):
    text = f"Visualization Manager: {{Displays: [{{Class: x/PointCloud2, {given}}}]}}"
    view = read_rviz(text)
    assert view.unread.startswith(f"Invalid values, defaults used: PointCloud2: {why}")
    assert view.displays[0].options == {}


def test_links_and_namespaces_of_a_file():
    text = """
Visualization Manager:
  Displays:
    - Class: rviz_default_plugins/RobotModel
      Description File: /tmp/a.urdf
      Description Source: File
      Links: {All Links Enabled: true, base: {Alpha: 0.5, Show Axes: false, Value: true}}
      Mass Properties: {Inertia: true, Mass: false}
    - {Class: rviz_default_plugins/MarkerArray, Namespaces: {walls: false, doors: true}}
"""
    view = read_rviz(text)
    robot, markers = view.displays
    assert robot.options == {
        "source": "file", "description_file": "/tmp/a.urdf", "mass": False, "inertia": True,
        "links": {"base": {"shown": True, "alpha": 0.5}},
    }  # fmt: skip
    assert markers.options["namespaces"] == {"walls": {"shown": False}, "doors": {"shown": True}}
    again = read_rviz(write_rviz(view, {}, view))
    assert [each.options for each in again.displays] == [robot.options, markers.options]
    links = again.document["Visualization Manager"]["Displays"][0]["Links"]
    assert links["All Links Enabled"] is True
    assert links["base"] == {"Alpha": 0.5, "Show Axes": False, "Value": True}


NAMES = ["Class", "Topic", "Enabled", "Shape", "Color", "Alpha", "Displays", "Covariance", "Style"]


@given(
    st.lists(
        st.builds(
            lambda name, rest: {**rest, "Class": f"rviz_default_plugins/{name}"},
            st.sampled_from([*CLASSES, "TF", "Grid", "Group"]),
            st.dictionaries(st.sampled_from(NAMES), NONSENSE),
        ),
        max_size=4,
    )
)
def test_any_values_give_a_view(displays):
    text = yaml.safe_dump({"Visualization Manager": {"Displays": displays}})
    view = read_rviz(text)
    json.dumps(view.header(), allow_nan=False)


@pytest.mark.parametrize("type_name", display_types())
def test_each_display_has_one_of_rviz(type_name):
    kind = display_types()[type_name].kind
    name = class_for(kind, type_name)
    assert CLASSES[name][0] == kind


NUMBERS = st.floats(0.125, 1).map(lambda value: round(value, 3))


@given(
    st.sampled_from(["a", "odom"]),
    st.lists(st.sampled_from([*CLASSES]), max_size=4),
    NUMBERS,
    st.booleans(),
)
def test_written_data_is_read_again(fixed, names, number, flag):
    displays = tuple(
        SavedDisplay(
            CLASSES[name][0],
            f"/{k}/update",
            {"alpha": number, "color": "#0a0b0c", "keep": 3, "collision": flag},
            visible=flag,
        )
        for k, name in enumerate(names)
    )
    show = {"names": flag, "axes": True, "arrows": False, "grid": flag}
    again = read_rviz(write_rviz(SavedView(fixed, displays, show), {}))
    assert (again.fixed, again.show, again.unread) == (fixed, show, "")
    for before, after in zip(displays, again.displays, strict=True):
        assert (after.kind, after.topic, after.visible) == (before.kind, before.topic, flag)
        assert {name: after.options[name] for name in after.options if name in before.options} == {
            name: value for name, value in before.options.items() if name in after.options
        }


@given(NONSENSE, NONSENSE, NONSENSE)
def test_requests_that_make_no_sense_are_refused_or_answered(first, second, third):
    save = {"type": "save", "displays": first, "show": second, "fixed": third}
    publish = {"type": "publish", "tool": "goal", "position": first, "yaw": second, "topic": third}
    with contextlib.suppress(CommandError):
        text_of_view(READER.read(json.dumps(save)), {})
    with contextlib.suppress(CommandError):
        message_of_tool(READER.read(json.dumps(publish)), "map", (0.0, 0.0, 0.0), 0)


@given(st.dictionaries(st.sampled_from(["alpha", "color", "keep", "size", "shape"]), NONSENSE))
def test_any_options_are_saved(options):
    display = {"kind": "odometry", "topic": "/odom", "options": options}
    text = text_of_view(SaveView("map", [display], {}), {})
    assert read_rviz(text).displays[0].kind == "odometry"
    with pytest.raises(CommandError, match="must have strings"):
        text_of_view(SaveView("", [{"kind": 1}], {}), {})


def file_with(current):
    manager = {"Displays": [], "Views": {"Current": current}}
    return yaml.safe_dump({"Visualization Manager": manager})


def test_the_camera_of_a_file():
    orbit = {"Class": "rviz_default_plugins/Orbit", "Distance": 4.5, "Yaw": 1.5, "Pitch": 0.3,
             "Focal Point": {"X": 1, "Y": 2, "Z": 3}, "Target Frame": "base_link"}  # fmt: skip
    camera = read_rviz(file_with(orbit)).camera
    assert camera == {"kind": "orbit", "frame": "base_link", "focus": [1.0, 2.0, 3.0],
                      "distance": 4.5, "yaw": 1.5, "pitch": 0.3, "scale": None}  # fmt: skip
    top = {"Class": "rviz_default_plugins/TopDownOrtho", "Scale": 50, "X": 3, "Y": -1,
           "Target Frame": "<Fixed Frame>"}  # fmt: skip
    camera = read_rviz(file_with(top)).camera
    assert (camera["kind"], camera["frame"], camera["focus"]) == ("top", "", [3.0, -1.0, 0.0])
    assert camera["scale"] == 50


def test_the_camera_of_a_file_with_numbers_that_are_too_large():
    orbit = {"Class": "rviz_default_plugins/Orbit", "Distance": 10**400, "Yaw": 1}
    camera = read_rviz(file_with(orbit)).camera
    assert (camera["distance"], camera["yaw"]) == (10.0, 1.0)


@pytest.mark.parametrize(
    "current",
    [None, [], "Orbit", {"Class": "rviz_default_plugins/FPS", "Yaw": 1},
     {"Class": "rviz_default_plugins/Orbit", "Name": "Current View"}],
)  # fmt: skip
def test_a_file_without_a_camera_of_ours(current):
    assert read_rviz(file_with(current)).camera is None


@given(
    kind=st.sampled_from(["orbit", "top"]),
    frame=st.sampled_from(["", "base_link"]),
    numbers=st.lists(st.floats(-100, 100), min_size=4, max_size=4),
    distance=st.floats(0.01, 1000),
)
def test_cameras_that_are_written_are_read_again(kind, frame, numbers, distance):
    x, y, yaw, pitch = numbers
    top = kind == "top"
    camera = {"kind": kind, "frame": frame, "focus": [x, y, 0.0 if top else 1.0]}
    camera |= {"distance": distance, "yaw": yaw, "pitch": pitch, "scale": 20.0 if top else None}
    again = read_rviz(text_of_view(SaveView("map", [], {}, camera), {})).camera
    words = ["kind", "frame", "focus", "scale"] if top else list(camera)
    assert {word: again[word] for word in words} == {word: camera[word] for word in words}


@pytest.mark.parametrize(
    "camera",
    [None, 5, {}, {"kind": "orbit", "frame": 3}, {"kind": "x"},
     {"kind": "orbit", "frame": "", "focus": [10**400, 0, 0], "distance": 1, "yaw": 1, "pitch": 1}],
)  # fmt: skip
def test_a_camera_that_makes_no_sense_is_not_saved(camera):
    assert read_rviz(text_of_view(SaveView("map", [], {}, camera), {})).camera is None
