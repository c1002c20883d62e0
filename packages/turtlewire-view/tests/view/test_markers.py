"""Markers: all types and actions, lifetimes, and one line for what is wrong."""

import math

import pytest

from turtlewire import msg
from turtlewire_view.displays.content import Content, Removal
from turtlewire_view.displays.marker import MarkerDisplay
from turtlewire_view.displays.marker_shapes import MARKER_TYPES

Point = msg.get_message("geometry_msgs/msg/Point")
Color = msg.get_message("std_msgs/msg/ColorRGBA")
Array = msg.get_message("visualization_msgs/msg/MarkerArray")
SEVERAL = {"line_strip", "line_list", "cube_list", "sphere_list", "points", "triangle_list"}


def marker(shape="cube", *, key=("robot", 1), action=0, frame="map", points=0, colors=0, **values):
    message = msg.get_message("visualization_msgs/msg/Marker")()
    message.header.frame_id = frame
    message.type = MARKER_TYPES.index(shape) if isinstance(shape, str) else shape
    message.action = action
    message.ns, message.id = key
    message.pose.orientation.w = 1.0
    message.scale.x = message.scale.y = message.scale.z = 0.5
    message.color.r = message.color.a = 1.0
    message.points = [Point(x=float(k)) for k in range(points)]
    message.colors = [Color(g=1.0, a=0.5)] * colors
    for name, value in values.items():
        setattr(message, name, value)
    return message


def shown(outputs):
    return [each for output in outputs if isinstance(output, Content)
            for each in output.header.get("markers", [])]  # fmt: skip


@pytest.mark.parametrize("shape", MARKER_TYPES)
def test_every_type_is_sent(meshes, shape):
    (meshes / "a.stl").touch()
    several = shape in SEVERAL or shape == "arrow_strip"
    message = marker(shape, points=6 if several else 0, text="hello",
                     mesh_resource="package://arm/meshes/a.stl")  # fmt: skip
    content, status = MarkerDisplay().content(message)
    assert status.level == "ok"
    (sent,) = shown([content])
    assert sent["shape"] == shape
    assert sent["key"] == ["robot", 1]
    assert sent["pose"] == [0, 0, 0, 0, 0, 0, 1]
    assert sent["color"] == [255, 0, 0, 255]
    assert sent["points"] == [0, 6 if several else 0]
    assert sent.get("text") == ("hello" if shape == "text" else None)
    if shape == "mesh":
        assert sent["mesh"]["url"] == "/mesh/arm/meshes/a.stl"
        assert [name for name, _ in content.packages] == ["arm"]


def test_an_array_travels_as_one_part_for_each_frame():
    message = Array(markers=[
        marker("points", key=("a", 1), points=2, colors=2),
        marker("line_strip", key=("a", 2), points=3),
        marker(key=("b", 1), frame="odom", frame_locked=True),
    ])  # fmt: skip
    first, second, status = MarkerDisplay().content(message)
    assert status.level == "ok"
    assert [each["points"] for each in first.header["markers"]] == [[0, 2], [2, 3]]
    assert [each["colors"] for each in first.header["markers"]] == [[0, 2], [2, 0]]
    assert first.arrays["points"][:, 0].tolist() == [0, 1, 0, 1, 2]
    assert first.arrays["colors"].tolist() == [[0, 255, 0, 128]] * 2
    assert (second.frame_id, second.locked) == ("odom", True)
    assert not first.locked


def test_a_replaced_marker_empties_its_part():
    display = MarkerDisplay()
    first = display.content(marker())[0]
    outputs = display.content(marker())
    assert outputs[1] == Removal(first.part)
    assert outputs[0].part != first.part


def test_delete_and_deleteall():
    display = MarkerDisplay()
    part = display.content(Array(markers=[marker(key=("a", k)) for k in range(3)]))[0].part
    delete, status = display.content(marker(action=2, key=("a", 1)))
    assert (delete.header, delete.event) == ({"delete": [["a", 1]]}, True)
    assert status.level == "ok"
    assert len(display.content(marker(action=2, key=("a", 1)))) == 1  # it is gone already
    clear, new, removal, _ = display.content(
        Array(markers=[marker(key=("c", 1)), marker(action=3), marker(key=("d", 1))])
    )
    assert clear.header == {"clear": True}
    assert [each["key"] for each in new.header["markers"]] == [["d", 1]]
    assert removal == Removal(part)


def test_the_last_marker_of_a_key_in_a_message_counts():
    outputs = MarkerDisplay().content(
        Array(
            markers=[marker("cube"), marker("sphere", frame="odom"), marker(action=2, key=("x", 1))]
        )
    )
    assert [each["shape"] for each in shown(outputs)] == ["sphere"]


@pytest.mark.parametrize("in_one_message", [True, False])
def test_only_so_many_markers_are_shown(monkeypatch, in_one_message):
    monkeypatch.setattr("turtlewire_view.displays.marker._MOST_MARKERS", 3)
    display = MarkerDisplay()
    messages = [marker(key=("a", k)) for k in range(4)]
    for each in [Array(markers=messages[:3])] if in_one_message else messages[:3]:
        assert display.content(each)[-1].level == "ok"
    assert display.content(messages[3])[-1].text == "marker a/3: there are 3 markers already"
    assert display.content(messages[2])[-1].level == "ok"  # one of the three
    replaced = Array(markers=[marker(action=2, key=("a", 0)), messages[3]])
    assert display.content(replaced)[-1].level == "ok"


def test_one_message_does_not_exceed_the_limit(monkeypatch):
    monkeypatch.setattr("turtlewire_view.displays.marker._MOST_MARKERS", 3)
    messages = [marker(key=("a", k)) for k in (0, 1, 2, 3, 1)]
    *outputs, status = MarkerDisplay().content(Array(markers=messages))
    assert sorted(each["key"] for each in shown(outputs)) == [["a", 0], ["a", 1], ["a", 2]]
    assert status.text.startswith("marker a/3: there are 3 markers already")


def test_expired_markers_are_forgotten():
    now = 0
    display = MarkerDisplay(clock=lambda: now)
    message = marker()
    message.lifetime.sec = 2
    first = display.content(message)[0]
    assert first.header["markers"][0]["lifetime"] == 2
    now = 2 * 10**9
    assert Removal(first.part) not in display.content(marker(key=("other", 1)))
    now += 1
    assert Removal(first.part) in display.content(marker(key=("other", 1)))


def test_too_many_points_are_thinned():
    display = MarkerDisplay()
    display.budget = 9
    for shape in ("points", "triangle_list", "line_list", "line_strip"):
        content, *_, status = display.content(marker(shape, points=3000, colors=3000))
        assert len(content.arrays["points"]) <= 9
        assert len(content.arrays["colors"]) == len(content.arrays["points"])
        assert "of 3000 points are drawn" in status.text
        assert status.level == "warn"


def wrong(**values):
    return MarkerDisplay().content(marker(**values))


@pytest.mark.parametrize(
    ("values", "line"),
    [
        ({"shape": 13}, "the type 13 is unknown (0 to 12 are known)"),
        ({"shape": "line_strip", "points": 1}, "line_strip: 1 point, but it needs 2"),
        ({"shape": "arrow", "points": 1}, "arrow: 1 point, but it needs 2"),
        ({"shape": "line_list", "points": 3}, "a line_list needs a multiple of 2"),
        ({"shape": "points", "points": 3, "colors": 2}, "2 colors for 3 points"),
        ({"frame": ""}, "header.frame_id is empty"),
        ({"action": 7}, "the action 7 is unknown"),
        ({"shape": "mesh"}, "mesh_resource is empty"),
        ({"shape": "text"}, "the text is empty"),
        ({"color": Color(r=1.0)}, "the marker is invisible: color.a is 0"),
        (
            {"shape": "mesh", "mesh_resource": "package://../../etc/passwd"},
            "'package://../../etc/passwd' is not loaded: '..' is not the name of a package",
        ),
    ],
)
def test_mistakes_are_one_line(values, line):
    status = wrong(**values)[-1]
    assert line in status.text
    assert status.level == "warn"
    assert status.text.startswith("marker robot/1: ")


def test_scales_poses_and_points_that_are_no_numbers():
    message = marker()
    message.scale.y = math.nan
    assert "not finite" in MarkerDisplay().content(message)[-1].text
    message = marker()
    message.pose.position.x = math.inf
    assert "the pose holds" in MarkerDisplay().content(message)[-1].text
    message = marker("triangle_list", points=6)
    message.points[1].y = math.nan
    content, status = MarkerDisplay().content(message)
    assert content.arrays["points"][:, 0].tolist() == [3, 4, 5]
    assert "3 of 6 points are left out" in status.text


def test_an_embedded_mesh_travels_with_the_marker():
    message = marker("mesh", mesh_resource="embedded://a.stl")
    message.mesh_file.filename = "a.stl"
    message.mesh_file.data = b"solid"
    content, status = MarkerDisplay().content(message)
    assert status.level == "ok"
    assert bytes(content.arrays["files"]) == b"solid"
    assert content.header["markers"][0]["file"] == [0, 5]


@pytest.mark.parametrize("shape", sorted(SEVERAL))
@pytest.mark.parametrize("colors", [0, 3, 9])
def test_rows_are_shown_as_messages_are(shape, colors):
    message = marker(shape, points=9, colors=colors)
    message.points[4].y = math.nan
    rows = msg.deserialize(type(message), msg.serialize(message), arrays=True)
    assert len(rows.points.shape) == 2  # no object for each point
    shown_rows, shown_messages = (MarkerDisplay().content(each) for each in (rows, message))
    assert shown_rows[0].header == shown_messages[0].header
    for name, array in shown_messages[0].arrays.items():
        assert shown_rows[0].arrays[name].tolist() == array.tolist()
    assert shown_rows[1:] == shown_messages[1:]


def textured(**values):
    uv = msg.get_message("visualization_msgs/msg/UVCoordinate")
    coordinates = [uv(u=float(k), v=0.5) for k in range(9)]
    return marker("triangle_list", points=9, **{"uv_coordinates": coordinates, **values})


def test_thinned_triangles_keep_their_place_in_the_texture():
    message = textured(texture_resource="embedded://a")
    message.texture.data = b"image"
    display = MarkerDisplay()
    display.budget = 6
    content, status = display.content(message)
    assert status.text == "marker robot/1: 6 of 9 points are drawn"
    assert content.arrays["uv"][:, 0].tolist() == content.arrays["points"][:, 0].tolist()
    assert bytes(content.arrays["files"]) == b"image"
    (sent,) = shown([content])
    assert sent["texture"] == {"name": "embedded://a"}
    assert (sent["uv"], sent["file"]) == ([0, 6], [0, 5])


@pytest.mark.parametrize(
    ("values", "line"),
    [
        ({}, "texture_resource is empty: the triangles have no texture"),
        ({"texture_resource": "embedded://a"},
         "'embedded://a' is not drawn: the field texture of this message is empty"),
        ({"texture_resource": "embedded://a", "uv_coordinates": []},
         "0 uv_coordinates for 9 points: the texture is not drawn"),
        ({"texture_resource": "package://arm/a.stl", "uv_coordinates": []},
         "0 uv_coordinates for 9 points: the texture is not drawn"),
        ({"texture_resource": "package://no such/a.png"},
         "'package://no such/a.png' is not loaded: 'no such' is not the name of a package"),
    ],
)  # fmt: skip
def test_invalid_textures(values, line):
    content, status = MarkerDisplay().content(textured(**values))
    assert (status.level, status.text) == ("warn", f"marker robot/1: {line}")
    (sent,) = shown([content])
    assert sent["texture"] is None
    assert not len(content.arrays["uv"])


def test_duplicate_markers_are_reported_and_the_last_is_drawn():
    *outputs, status = MarkerDisplay().content(
        Array(markers=[marker("cube"), marker("sphere"), marker("cube", key=("robot", 2))])
    )
    assert [each["shape"] for each in shown(outputs)] == ["sphere", "cube"]
    assert status.level == "warn"
    assert status.text == (
        "Multiple Markers in the same MarkerArray message had the same ns and id: (robot, 1)"
    )


@pytest.mark.parametrize("between", [marker(action=2), marker(action=3)])
def test_a_marker_that_is_deleted_in_between_is_no_duplicate(between):
    *_, status = MarkerDisplay().content(Array(markers=[marker(), between, marker()]))
    assert status.level == "ok"


@pytest.mark.parametrize(
    ("w", "said"),
    [
        (0.0, "marker robot/1: Uninitialized quaternion, assuming identity."),
        (0.5, "marker robot/1: Unnormalized quaternion, drawn with length 1."),
        (1.004, ""),
        (-1.0, ""),
    ],
)
def test_invalid_quaternion_is_reported(w, said):
    message, text = marker(), marker("text", text="a")
    message.pose.orientation.w = text.pose.orientation.w = w
    content, status = MarkerDisplay().content(message)
    assert shown([content])[0]["pose"] == [0, 0, 0, 0, 0, 0, math.copysign(1, w or 1)]
    assert status.text == said
    assert MarkerDisplay().content(text)[-1].level == "ok"  # it faces the camera
