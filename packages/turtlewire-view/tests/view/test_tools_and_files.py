"""Tools of the page, and views as files, in a real browser."""

# ruff: noqa: F811 - fixtures are imported

import math

import pytest
import yaml

from turtlewire import msg

from .looking_down import (  # noqa: F401 - fixtures
    GROUND,
    LIMIT_MS,
    REMOVE_ALL,
    get,
    pose,
    scene,
    shown_page,
    stamped,
)

ON_SCREEN = """async (place) => {
    const { stage } = await import("./js/main.js");
    const { Vector3 } = await import("three");
    const { x, y } = stage.view.project(new Vector3(...place));
    const box = stage.view.canvas.getBoundingClientRect();
    return [box.left + x, box.top + y];
}"""
#: Metres: a pixel of the picture is about a centimetre.
NEAR = 0.03


def press(scene, *places):
    """Press at the first place, move over the others and release."""
    mouse = scene.page.mouse
    at = [scene.page.evaluate(ON_SCREEN, place) for place in places]
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
