"""Interactive markers in a real browser: handles are drawn, dragged, clicked, and have menus."""

import math

import pytest
from tests.pages import PROJECT

from turtlewire import msg

from .looking_down import ADD, LIMIT_MS
from .test_interactive_markers import Control, Entry, Feedback, Marker, Pose, Service, Shape, Update

KEEP_ALIVE, POSE, MENU, CLICK, DOWN, UP = range(6)
#: Whether the last display has something, which is drawn then.
IS_DRAWN = """async () => {
    const { displays, stage } = await import("./js/main.js");
    if (!displays.list.at(-1).parts?.object.children.length) return false;
    stage.view.draw(performance.now());
    return true;
}"""
MODES = {name: number for number, name in enumerate(
    ("none", "menu", "button", "move_axis", "move_plane", "rotate_axis", "move_rotate", "move_3d",
     "rotate_3d", "move_rotate_3d"))}  # fmt: skip


class Server:
    """A server of markers, and the user who moves them."""

    def __init__(self, scene):
        self.scene, self.source, self.mouse = scene, scene.source, scene.page.mouse
        self.namespace = scene.topic
        self.number = 0
        self.source.published.clear()

    def show(self, *markers, **options):
        self.source.offer(f"{self.namespace}/update", Update(type=1, seq_num=0))
        response = Service.Response(sequence_number=0, markers=markers)
        self.source.respond(f"{self.namespace}/get_interactive_markers", response)
        options = {"transparency": False, **options}
        topic = f"{self.namespace}/update"
        self.scene.page.evaluate(ADD, ["interactive_markers", topic, options])
        self.scene.wait_until(IS_DRAWN)

    def send(self, *, markers=(), poses=(), erases=()):
        self.number += 1
        values = {"markers": markers, "poses": poses, "erases": erases}
        self.source.send(f"{self.namespace}/update", Update(type=1, seq_num=self.number, **values))

    def at(self, *place):
        return self.scene.page.evaluate(PROJECT, place)

    def press(self, *place):
        self.mouse.move(*self.at(*place))
        self.mouse.down()

    def drag(self, start, *ends):
        self.press(*start)
        for end in ends:
            self.mouse.move(*self.at(*end), steps=4)
        self.mouse.up()
        return self.wait_for(UP)

    def all_feedback(self):
        return [msg.deserialize(Feedback, cdr) for _, _, cdr in list(self.source.published)]

    def feedback(self):
        return [each for each in self.all_feedback() if each.event_type != KEEP_ALIVE]

    def wait_for(self, event, count=1):
        """The first feedback of this type, after `count` of them were sent."""

        def found():
            return [each for each in self.all_feedback() if each.event_type == event]

        assert self.source.wait_until(lambda: len(found()) >= count), (
            f"no feedback {event}: {self.feedback()}, {self.scene.status()}"
        )
        return found()[0]


@pytest.fixture
def server(scene):
    return Server(scene)


def control(mode, *, name="", x=0.0, y=0.0, z=0.0, **values):
    message = Control(name=name or mode, interaction_mode=MODES[mode], **values)
    turn = message.orientation
    turn.x, turn.y, turn.z = float(x), float(y), float(z)
    return message


def knob(*controls, name="knob", frame="map", **values):
    message = Marker(name=name, controls=list(controls), scale=1.0, **values)
    message.header.frame_id = frame
    return message


def red_square(side=1.0):
    shape = Shape(type=1)
    shape.scale.x = shape.scale.y = side
    shape.scale.z = 0.01
    shape.color.r = shape.color.a = 1.0
    return shape


def yaw_of(pose):
    return 2 * math.atan2(pose.orientation.z, pose.orientation.w)


def moved(name, x):
    message = Pose(name=name)
    message.header.frame_id = "map"
    message.pose.position.x = x
    return message


def test_a_marker_moves_along_its_axis(server):
    server.show(knob(control("move_axis")))
    server.scene.expect_red((0.6, 0, 0), (-0.6, 0, 0))
    up = server.drag((0.7, 0, 0), (1.7, 1, 0))
    events = [each.event_type for each in server.feedback()]
    assert events[0] == DOWN
    assert events[-1] == UP
    assert POSE in events
    assert up.pose.position.x == pytest.approx(1, abs=0.05)
    assert (up.pose.position.y, up.marker_name, up.control_name) == (0, "knob", "move_axis")
    assert up.header.frame_id == "map"
    down = server.feedback()[0]
    assert (down.pose.position.x, down.mouse_point_valid) == (0, True)
    assert down.mouse_point.x == pytest.approx(0.7, abs=0.05)
    server.scene.expect_red((1.6, 0, 0))
    server.scene.expect_ground((-0.6, 0, 0))


def test_a_marker_moves_in_its_plane(server):
    # A control's plane is the one that its x axis is normal to.
    server.show(knob(control("move_plane", y=-1.0)))
    place = server.drag((0.57, 0.05, 0), (1.57, -0.95, 0)).pose.position
    assert (place.x, place.y, place.z) == pytest.approx((1, -1, 0), abs=0.05)


def test_a_marker_turns_about_its_axis(server):
    server.show(knob(control("rotate_axis", y=-1.0)))
    pose = server.drag((0.57, 0.05, 0), (0.4, 0.4, 0), (-0.05, 0.57, 0)).pose
    assert yaw_of(pose) == pytest.approx(math.pi / 2, abs=0.1)
    assert (pose.position.x, pose.position.y) == (0, 0)


def test_a_marker_turns_and_moves(server):
    server.show(knob(control("move_rotate", y=-1.0)))
    pose = server.drag((0.57, 0.05, 0), (1.57, 1.5, 0)).pose
    # The pressed point is where the pointer is, as far from the marker as before.
    away = (1.57 - pose.position.x, 1.5 - pose.position.y)
    assert math.hypot(*away) == pytest.approx(0.57, abs=0.05)
    assert yaw_of(pose) == pytest.approx(math.atan2(away[1], away[0]), abs=0.1)


@pytest.mark.parametrize("mode", ["move_3d", "move_rotate_3d"])
def test_a_marker_moves_freely(server, mode):
    server.show(knob(control(mode, markers=[red_square()])))
    server.scene.expect_red((0, 0, 0))
    place = server.drag((0.2, 0, 0), (1.2, 1, 0)).pose.position
    assert (place.x, place.y, place.z) == pytest.approx((1, 1, 0), abs=0.05)


def test_a_marker_turns_freely(server):
    server.show(knob(control("rotate_3d", markers=[red_square()])))
    server.scene.expect_red((0, 0, 0))
    turn = server.drag((0.2, 0, 0), (1.2, 0, 0)).pose.orientation
    assert turn.w < 0.98
    assert turn.y > 0.2


def test_a_button_is_clicked_and_a_drag_off_it_is_not(server):
    server.show(knob(control("button", markers=[red_square()])))
    server.scene.expect_red((0, 0, 0))
    server.drag((0.2, 0, 0), (2, 2, 0))
    assert [each.event_type for each in server.feedback()] == [DOWN, UP]
    server.mouse.click(*server.at(0, 0, 0))
    server.wait_for(CLICK)
    assert [each.event_type for each in server.feedback()][2:] == [DOWN, UP, CLICK]


def test_a_menu_opens_by_the_right_button(server):
    entries = [Entry(id=1, title="Open"), Entry(id=2, title="Modes"),
               Entry(id=3, parent_id=2, title="[x] Slow"),
               Entry(id=4, title="Run", command_type=1, command="pkg node")]  # fmt: skip
    server.show(knob(control("button", markers=[red_square()]), menu_entries=entries))
    server.scene.expect_red((0, 0, 0))
    page = server.scene.page
    server.mouse.click(*server.at(0, 0, 0), button="right")
    menu = page.wait_for_selector(".marker-menu", timeout=LIMIT_MS).bounding_box()
    assert (menu["x"], menu["y"]) == pytest.approx(server.at(0, 0, 0), abs=2)
    assert page.get_by_role("menuitem", name="Run").is_disabled()
    page.keyboard.press("Escape")
    page.wait_for_selector(".marker-menu", state="detached", timeout=LIMIT_MS)
    server.mouse.click(*server.at(0, 0, 0), button="right")
    page.click(".marker-menu summary")
    page.click(".marker-menu details button")
    feedback = server.wait_for(MENU)
    assert (feedback.menu_entry_id, feedback.marker_name) == (3, "knob")
    assert page.locator(".marker-menu").count() == 0


def test_a_menu_control_opens_by_a_click(server):
    menu = control("menu", markers=[red_square()])
    server.show(knob(menu, menu_entries=[Entry(id=7, title="Go")]))
    server.scene.expect_red((0, 0, 0))
    server.mouse.click(*server.at(0, 0, 0))
    server.scene.page.click(".marker-menu button")
    assert server.wait_for(MENU).menu_entry_id == 7


def test_the_server_s_pose_waits_until_the_user_lets_go(server):
    server.show(knob(control("move_axis")))
    server.scene.expect_red((0.6, 0, 0))
    server.press(0.7, 0, 0)
    server.mouse.move(*server.at(1.7, 0, 0), steps=4)
    server.wait_for(POSE)
    server.send(poses=[moved("knob", -2.0)])
    server.send(markers=[knob(control("button", markers=[red_square(0.5)]), name="other")])
    server.scene.expect_red((0, 0, 0), (1.6, 0, 0))  # the other one came after the pose
    server.mouse.up()
    server.scene.expect_red((-1.4, 0, 0), (-2.6, 0, 0))
    server.scene.expect_ground((1.6, 0, 0))


def test_a_held_control_is_kept_alive(server):
    server.show(knob(control("move_axis")))
    server.scene.expect_red((0.6, 0, 0))
    server.press(0.7, 0, 0)
    server.wait_for(KEEP_ALIVE, 2)
    server.mouse.up()
    server.wait_for(UP)


def test_erased_markers_and_markers_without_controls(server):
    server.show(knob(name="empty", description="x"), knob(control("move_axis")))
    server.scene.expect_red((0.6, 0, 0))
    server.press(0.7, 0, 0)
    server.wait_for(DOWN)
    server.send(erases=["knob"])
    server.scene.expect_ground((0.6, 0, 0))
    server.mouse.move(*server.at(1.7, 0, 0))
    server.mouse.up()
    server.send(markers=[knob(control("move_axis"), name="new")])
    server.scene.expect_red((0.6, 0, 0))


def test_markers_follow_their_frame(server):
    server.show(knob(control("move_axis"), frame="base"))
    server.scene.expect_red((1.6, 0, 0), (0.4, 0, 0))
    up = server.drag((1.7, 0, 0), (2.7, 0, 0))
    assert up.pose.position.x == pytest.approx(1, abs=0.05)
    assert up.header.frame_id == "base"


def test_a_control_that_faces_the_eye(server):
    # The ring is around the x axis, which faces the eye above.
    server.show(knob(control("move_plane", orientation_mode=2)))
    server.scene.expect_red((0.57, 0, 0), (0, 0.57, 0), (-0.57, 0, 0))
    place = server.drag((0.57, 0.05, 0), (1.57, 1.05, 0)).pose.position
    assert (place.x, place.y) == pytest.approx((1, 1), abs=0.05)


def test_a_tool_in_hand_moves_no_marker(server):
    server.show(knob(control("button", markers=[red_square()])))
    server.scene.expect_red((0, 0, 0))
    page = server.scene.page
    page.click("[data-tool=measure]")
    server.mouse.click(*server.at(0.1, 0, 0))
    server.mouse.click(*server.at(0.3, 0, 0))
    is_measured = "() => document.querySelector('#notice').textContent.includes(' m (x')"
    page.wait_for_function(is_measured, timeout=LIMIT_MS)
    assert server.feedback() == []
    page.keyboard.press("Escape")


@pytest.mark.slow
def test_thousands_of_controls_are_cut_with_one_line(server):
    server.show(knob(*[control("move_axis")] * 10_000))
    server.scene.expect_status("1000 of 10000 controls are drawn")
    server.scene.expect_red((0.6, 0, 0))
    server.drag((0.7, 0, 0), (1.7, 0, 0))


@pytest.mark.slow
def test_options_redraw_the_markers(server):
    server.show(knob(control("move_axis"), description="title"))
    server.scene.expect_red((0.6, 0, 0))
    server.scene.set_option("show_axes", True)
    server.scene.set_option("show_visual_aids", True)
    server.scene.set_option("show_descriptions", False)
    up = server.drag((0.7, 0, 0), (1.2, 0, 0))
    assert up.pose.position.x == pytest.approx(0.5, abs=0.05)
    server.scene.expect_red((1.1, 0, 0))
