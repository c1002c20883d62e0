"""Tools of the page, panels of displays, and views as files, in a real browser."""

import math

import pytest
import yaml
from tests.pages import PROJECT

from turtlewire import msg

from .looking_down import GROUND, LIMIT_MS, REMOVE_ALL, get, pose, stamped

#: Metres: a pixel of the picture is about a centimetre.
NEAR = 0.03


def press(scene, *places):
    """Press at the first place, move over the others and release."""
    mouse = scene.page.mouse
    at = [scene.page.evaluate(PROJECT, place) for place in places]
    mouse.move(*at[0])
    mouse.down()
    for place in at[1:]:
        mouse.move(*place)
    mouse.up()


def published(scene, topic):
    scene.page.wait_for_function(
        "(text) => document.querySelector('#notice').textContent === text",
        arg=f"Published on {topic}",
        timeout=LIMIT_MS,
    )
    to, type_name, cdr = scene.source.published[-1]
    assert to == topic
    return msg.deserialize(get(type_name), cdr)


def test_a_topic_without_listeners_is_named(scene):
    scene.source.listeners = 0
    take(scene, "point")
    scene.page.mouse.click(450, 350)
    notice = scene.page.locator("#notice", has_text="but no node subscribes to it")
    notice.wait_for(timeout=LIMIT_MS)
    scene.source.listeners = 1


def test_escape_puts_away_the_tool_and_only_then_the_frame(scene):
    page = scene.page
    page.click("#tree .row:has(.name:text-is('base'))")
    take(scene, "goal")
    page.keyboard.press("Escape")
    assert page.get_attribute("[data-tool=goal]", "aria-pressed") == "false"
    assert page.input_value("#relation-source") == "base"
    page.keyboard.press("Escape")
    assert page.input_value("#relation-source") == ""


def take(scene, tool):
    scene.page.click(f"[data-tool={tool}]")
    assert scene.page.get_attribute(f"[data-tool={tool}]", "aria-pressed") == "true"


def test_publish_point(scene):
    take(scene, "point")
    press(scene, [1.5, -2, 0])
    point = published(scene, "/clicked_point")
    assert point.header.frame_id == "map"
    assert (point.point.x, point.point.y) == pytest.approx((1.5, -2), abs=NEAR)
    assert point.point.z == pytest.approx(0, abs=1e-6)
    assert scene.page.get_attribute("[data-tool=point]", "aria-pressed") == "false"


def test_publish_point_on_what_is_drawn(scene):
    message = stamped("geometry_msgs/msg/PointStamped", "base")
    message.point.z = 1.0
    scene.show("point", message, color="#ff0000", radius=0.5)
    scene.expect_red((1, 0, 1))
    scene.page.keyboard.press("c")
    press(scene, [1, 0, 0])
    assert published(scene, "/clicked_point").point.z == pytest.approx(1.5, abs=0.05)


@pytest.mark.parametrize(
    ("tool", "topic"), [("goal", "/goal_pose"), ("pose_estimate", "/initialpose")]
)
def test_poses(scene, tool, topic):
    take(scene, tool)
    press(scene, [1, 1, 0], [1, 2, 0], [0, 2, 0])
    message = published(scene, topic)
    sent = message.pose.pose if tool == "pose_estimate" else message.pose
    assert (sent.position.x, sent.position.y) == pytest.approx((1, 1), abs=NEAR)
    yaw = 2 * math.atan2(sent.orientation.z, sent.orientation.w)
    assert yaw == pytest.approx(3 * math.pi / 4, abs=0.05)
    if tool == "pose_estimate":
        assert message.pose.covariance[35] == pytest.approx((math.pi / 12) ** 2)


def test_measure(scene):
    take(scene, "measure")
    press(scene, [-1, 0, 0])
    press(scene, [2, 3, 0])
    scene.expect(((0, 1, 0), (255, 140, 0)))
    length, _, rest = scene.page.inner_text("#notice").partition(" m ")
    assert float(length) == pytest.approx(math.hypot(3, 3), abs=2 * NEAR)
    assert rest.startswith("(x ")
    scene.page.keyboard.press("Escape")
    scene.expect_ground((0, 1, 0))
    assert not scene.source.published or scene.source.published[-1][0] != "measure"


def test_a_tool_that_is_put_away_publishes_nothing(scene):
    before = len(scene.source.published)
    take(scene, "goal")
    scene.page.keyboard.press("Escape")
    press(scene, [1, 1, 0], [1, 1, 0])
    assert len(scene.source.published) == before


def test_a_view_is_saved_and_loaded(scene, tmp_path):
    path = stamped("nav_msgs/msg/Path", poses=[])
    Stamped = get("geometry_msgs/msg/PoseStamped")  # noqa: N806
    path.poses = [Stamped(pose=pose(-1, 0)), Stamped(pose=pose(1, 0))]
    scene.show("path", path, color="#ff0000", width=0.2)
    scene.expect(((0, 0, 0), (255, 0, 0)))
    scene.page.evaluate("document.querySelector('#looks').open = true")
    with scene.page.expect_download() as download:
        scene.page.click("#save-view")
    file = tmp_path / "view.rviz"
    download.value.save_as(file)
    saved = yaml.safe_load(file.read_text())["Visualization Manager"]
    (shown,) = [each for each in saved["Displays"] if each.get("Name") == "Path"]
    assert shown["Class"] == "rviz_default_plugins/Path"
    assert (shown["Color"], shown["Line Width"]) == ("255; 0; 0", 0.2)
    scene.page.evaluate(REMOVE_ALL)
    scene.expect_ground((0, 0, 0))
    scene.page.set_input_files("#view-file", file)
    scene.expect(((0, 0, 0), (255, 0, 0)))
    assert scene.page.input_value("#fixed") == "map"
    file.write_text(file.read_text().replace("Fixed Frame: map", "Fixed Frame: tip"))
    scene.page.set_input_files("#view-file", file)
    scene.expect(((0, 0, 0), GROUND), ((-1, -1, 0), (255, 0, 0)))
    file.write_text(file.read_text().replace("Fixed Frame: tip", "Fixed Frame: map"))
    scene.page.set_input_files("#view-file", file)
    scene.expect(((0, 0, 0), (255, 0, 0)))


def test_a_file_that_is_no_view_is_a_line(scene, tmp_path):
    file = tmp_path / "view.rviz"
    file.write_text("Displays: {")
    scene.page.set_input_files("#view-file", file)
    scene.page.wait_for_function(
        "() => document.querySelector('#notice').textContent.startsWith('This is not a view: ')",
        timeout=LIMIT_MS,
    )


@pytest.mark.slow
def test_unsupported_parts_of_a_view_are_listed_until_they_are_dismissed(scene, tmp_path):
    file = tmp_path / "view.rviz"
    file.write_text(
        "Visualization Manager:\n  Displays:\n"
        "    - {Class: rviz_default_plugins/Velodyne}\n    - {Class: mine/<b>Wind</b>}\n"
        "  Global Options: {Fixed Frame: map}\n"
    )
    scene.page.set_input_files("#view-file", file)
    line = scene.page.locator("#unread span", has_text="Unsupported displays: Velodyne, b>")
    line.wait_for(timeout=LIMIT_MS)
    scene.source.listeners = 0
    take(scene, "point")
    scene.page.mouse.click(450, 350)
    other = scene.page.locator("#notice", has_text="but no node subscribes to it")
    other.wait_for(timeout=LIMIT_MS)
    other.wait_for(state="hidden", timeout=LIMIT_MS)  # a line that passes, and took six seconds
    scene.source.listeners = 1
    assert line.is_visible()
    scene.page.get_by_label("Dismiss").click()
    assert not line.is_visible()
    scene.page.set_input_files("#view-file", file)
    line.wait_for(timeout=LIMIT_MS)
    file.write_text("Visualization Manager: {Global Options: {Fixed Frame: map}}")
    scene.page.set_input_files("#view-file", file)
    line.wait_for(state="hidden", timeout=LIMIT_MS)


def test_of_two_views_loaded_in_a_row_the_last_one_is_shown(fake, open_view):
    page = open_view(fake.url)
    first = [{"kind": "path", "topic": f"/first{number}"} for number in range(5)]
    last = [{"kind": "path", "topic": f"/last{number}"} for number in range(5)]
    for displays in (first, last):
        fake.tell({"type": "view", "fixed": "", "displays": displays, "show": {}, "text": ""})
    fake.wait_for(lambda command: command.get("topic") == "/last4")
    shown = page.locator("#display-list .title b").all_inner_texts()
    assert shown == [each["topic"] for each in last]


ROBOT = """<robot name="r">
  <link name="base">
    <visual><origin xyz="1 0 0"/><geometry><box size="1 1 0.2"/></geometry>
      <material name="red"><color rgba="1 0 0 1"/></material></visual>
    <inertial><origin xyz="-2 0 0"/><mass value="6000"/>
      <inertia ixx="1000" iyy="1000" izz="1000" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="tip">
    <visual><origin xyz="1 1 0"/><geometry><box size="1 1 0.2"/></geometry>
      <material name="red"/></visual>
  </link>
  <joint name="j" type="fixed"><parent link="base"/><child link="tip"/></joint>
</robot>"""
BASE, TIP, MASS, INERTIA = (2, 0, 0), (2, 2, 0), (-1.1, 0, 0), (-1.4, -0.4, 0)


def open_options(page):
    page.click("#display-list summary")


def set_slider(page, label, value):
    page.get_by_label(label).evaluate(
        "(slider, value) => { slider.value = value; slider.dispatchEvent(new Event('input')); }",
        value,
    )


def test_a_robot_of_a_parameter_and_its_links(scene):
    page = scene.page
    scene.source.parameters["/describer", "description"] = ROBOT
    page.select_option("#topic", label="robot from a parameter or file")
    page.click("#add-display")
    scene.expect_status("the node /robot_state_publisher has no parameter 'robot_description'")
    open_options(page)
    page.get_by_label("Node of the parameter").fill("/describer")
    page.keyboard.press("Enter")
    page.get_by_label("Parameter", exact=True).fill("description")
    page.keyboard.press("Enter")
    scene.expect_red(BASE, TIP)
    page.get_by_label("tip", exact=True).uncheck()
    scene.expect_ground(TIP)
    scene.expect_red(BASE)
    set_slider(page, "Alpha of base", 0)
    scene.expect_ground(BASE)
    set_slider(page, "Alpha of base", 1)
    page.get_by_label("Mass").check()
    scene.expect_red(MASS)
    scene.expect_ground(INERTIA)
    page.get_by_label("Inertia").check()
    scene.expect_red(INERTIA)
    page.get_by_label("All").check()
    scene.expect_red(TIP)
    page.get_by_label("Description from").select_option("file")
    scene.expect_status("no file is chosen")
    scene.expect_ground(TIP)


def test_namespaces_have_check_boxes(scene):
    MarkerArray = get("visualization_msgs/msg/MarkerArray")  # noqa: N806
    markers = []
    for name, x in (("walls", 1.0), ("doors", 3.0)):
        marker = stamped("visualization_msgs/msg/Marker", type=1, ns=name)
        marker.pose = pose(x, 0)
        marker.scale.x = marker.scale.y = marker.scale.z = 1.0
        marker.color.r = marker.color.a = 1.0
        markers.append(marker)
    scene.show("marker", MarkerArray(markers=markers))
    scene.expect_red((1, 0, 0), (3, 0, 0))
    open_options(scene.page)
    scene.page.get_by_label("walls").uncheck()
    scene.expect_ground((1, 0, 0))
    scene.expect_red((3, 0, 0))
    scene.send(MarkerArray(markers=markers))  # new ones of a hidden namespace are hidden, too
    scene.send(
        MarkerArray(markers=[stamped("visualization_msgs/msg/Marker", action=2, ns="doors")])
    )
    scene.expect_ground((1, 0, 0), (3, 0, 0))


def test_a_display_shows_another_topic(scene):
    def polygon(x):
        Point32 = get("geometry_msgs/msg/Point32")  # noqa: N806
        corners = [(x, -1), (x + 0.01, 1)]
        points = [Point32(x=float(a), y=float(b)) for a, b in corners]
        return stamped("geometry_msgs/msg/PolygonStamped", polygon=get(
            "geometry_msgs/msg/Polygon")(points=points))  # fmt: skip

    blue = (0, 0, 255)
    scene.source.offer("/other_area", polygon(2))
    scene.show("polygon", polygon(-2), color="#0000ff")
    scene.expect(((-2, 0, 0), blue), tolerance=40)
    open_options(scene.page)
    scene.page.get_by_label("Topic", exact=True).fill("/other_area")
    scene.page.keyboard.press("Enter")
    scene.expect(((2, 0, 0), blue), tolerance=40)
    scene.expect_ground((-2, 0, 0))
    assert scene.page.inner_text("#display-list .title b") == "/other_area"


def test_a_wrong_option_is_refused_with_a_line(scene):
    scene.show("point", stamped("geometry_msgs/msg/PointStamped"), color="#ff0000", radius=1)
    scene.expect_red((0.5, 0, 0))
    scene.set_option("radius", "big")
    scene.page.wait_for_function(
        "() => document.querySelector('#notice').textContent.includes("
        "\"option 'radius' of a point must be a number from 0.001 to 1000, got 'big'\")"
    )
