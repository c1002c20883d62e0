"""The node as other nodes see it.

Topics, services, parameters and texts, in one process on the `local` middleware.
"""

from __future__ import annotations

import contextlib
import itertools
import json
import math
import re
import time

import pytest
from websockets.sync.client import connect

import rclpy
from action_msgs.msg import GoalStatus
from geometry_msgs.msg import Twist
from rclpy.action import ActionClient, get_action_server_names_and_types_by_node
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock
from std_srvs.srv import Empty
from turtlesim.action import RotateAbsolute
from turtlesim.model import TICK_NS
from turtlesim.msg import Color, Pose
from turtlesim.options import parse_options
from turtlesim.srv import Kill, SetPen, Spawn, TeleportAbsolute, TeleportRelative
from turtlesim.turtlesim_node import TurtlesimNode, main

MIDDLE = 5.544444561004639


class World:
    """A simulator, a node that talks to it, and what it hears."""

    def __init__(self, *, headless: bool = True, **options) -> None:
        self.sim = TurtlesimNode(headless=headless, **options)
        self.user = Node("user")
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.sim)
        self.executor.add_node(self.user)

    def close(self) -> None:
        self.sim.destroy_node()
        self.user.destroy_node()
        self.executor.shutdown()

    def spin_until(self, is_done, timeout: float = 60.0) -> None:
        deadline = time.monotonic() + timeout
        while not is_done():
            assert time.monotonic() < deadline, "nothing happened"
            self.executor.spin_once(timeout_sec=0.1)

    def listen(self, kind, topic: str) -> list:
        heard: list = []
        self.user.create_subscription(kind, topic, heard.append, 100)
        return heard

    def call(self, kind, service: str, **fields):
        client = self.user.create_client(kind, service)
        self.spin_until(client.service_is_ready)
        future = client.call_async(kind.Request(**fields))
        self.spin_until(future.done)
        self.user.destroy_client(client)
        return future.result()

    def talk(self, topic: str):
        publisher = self.user.create_publisher(Twist, topic, 10)
        self.spin_until(lambda: publisher.get_subscription_count() > 0)
        return publisher


@pytest.fixture
def make_world(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    rclpy.init(args=[])
    worlds = []

    def make_world(**options) -> World:
        worlds.append(World(**options))
        return worlds[-1]

    yield make_world
    for world in worlds:
        world.close()
    rclpy.try_shutdown()


@pytest.fixture
def world(make_world):
    return make_world()


def twist(linear: float = 0.0, angular: float = 0.0, lateral: float = 0.0) -> Twist:
    message = Twist()
    message.linear.x, message.linear.y, message.angular.z = linear, lateral, angular
    return message


def lines(capfd) -> list[str]:
    """Return the log lines since the last call, with level and text."""
    matches = re.findall(
        r"^(\[[A-Z]+\]) \[[0-9.]+\] \[[a-z0-9.]+\]: (.*)$", capfd.readouterr().err, re.MULTILINE
    )
    return [f"{level} {text}" for level, text in matches]


def test_the_graph_is_that_of_the_original(world):
    topics = dict(world.user.get_publisher_names_and_types_by_node("turtlesim", "/"))
    assert topics["/turtle1/pose"] == ["turtlesim/msg/Pose"]
    assert topics["/turtle1/color_sensor"] == ["turtlesim/msg/Color"]
    assert dict(world.user.get_subscriber_names_and_types_by_node("turtlesim", "/"))[
        "/turtle1/cmd_vel"
    ] == ["geometry_msgs/msg/Twist"]
    services = dict(world.user.get_service_names_and_types_by_node("turtlesim", "/"))
    expected = {
        "/clear": "std_srvs/srv/Empty",
        "/kill": "turtlesim/srv/Kill",
        "/reset": "std_srvs/srv/Empty",
        "/spawn": "turtlesim/srv/Spawn",
        "/turtle1/set_pen": "turtlesim/srv/SetPen",
        "/turtle1/teleport_absolute": "turtlesim/srv/TeleportAbsolute",
        "/turtle1/teleport_relative": "turtlesim/srv/TeleportRelative",
    }
    assert {
        name: types[0]
        for name, types in services.items()
        if not re.search("_parameter|type_desc|_action/", name)
    } == expected
    assert get_action_server_names_and_types_by_node(world.user, "turtlesim", "/") == [
        ("/turtle1/rotate_absolute", ["turtlesim/action/RotateAbsolute"])
    ]
    (info,) = world.user.get_publishers_info_by_topic("/turtle1/pose")
    assert (
        info.qos_profile.depth,
        info.qos_profile.reliability.name,
        info.qos_profile.durability.name,
    ) == (7, "RELIABLE", "VOLATILE")


def test_poses_come_at_the_original_rate(world):
    start = time.monotonic()
    poses = world.listen(Pose, "/turtle1/pose")
    world.spin_until(lambda: len(poses) >= 62)
    assert (
        time.monotonic() - start > 0.9
    )  # 61 ticks of 16 ms; a busy machine skips some, and never catches up by hurrying
    assert poses[0] == Pose(
        x=MIDDLE, y=MIDDLE, theta=0.0, linear_velocity=0.0, angular_velocity=0.0
    )


def test_a_velocity_command_lasts_a_second(world):
    poses = world.listen(Pose, "/turtle1/pose")
    world.talk("/turtle1/cmd_vel").publish(twist(2.0))
    world.spin_until(lambda: poses and poses[-1].linear_velocity == 2.0)
    world.spin_until(lambda: poses[-1].linear_velocity == 0.0)
    moving = sum(pose.linear_velocity == 2.0 for pose in poses)
    assert 0 < moving < 65  # 62 or 63, less what a busy machine skipped
    assert poses[-1].x == pytest.approx(MIDDLE + moving * 0.032, abs=1e-5)


def test_non_finite_values_are_ignored_with_one_line(world, capfd):
    poses = world.listen(Pose, "/turtle1/pose")
    cmd_vel = world.talk("/turtle1/cmd_vel")
    capfd.readouterr()
    cmd_vel.publish(twist(math.nan))
    cmd_vel.publish(twist(angular=math.inf))
    cmd_vel.publish(twist(1e300))
    world.call(TeleportAbsolute, "/turtle1/teleport_absolute", x=math.nan)
    assert world.call(Spawn, "/spawn", x=math.inf).name == ""
    seen = len(poses)
    world.spin_until(lambda: len(poses) > seen + 3)
    assert (poses[-1].x, poses[-1].theta, poses[-1].linear_velocity) == (MIDDLE, 0.0, 0.0)
    logged = sorted(lines(capfd), reverse=True)
    assert [line[:7] for line in logged] == ["[WARN] "] * 3 + ["[ERROR]"] * 2
    assert (
        logged[0]
        == "[WARN] Ignored a velocity command for [turtle1] that is not finite: x=nan, y=0.0, "
        "angular z=0.0"
    )


def test_start_spawn_kill_and_reset_with_their_texts(make_world, capfd):
    world = make_world()
    assert lines(capfd) == [
        "[INFO] Starting turtlesim with node name /turtlesim",
        "[INFO] Spawning turtle [turtle1] at x=[5.544445], y=[5.544445], theta=[0.000000]",
    ]
    assert world.call(Spawn, "/spawn", x=4.0, y=2.0, theta=0.5, name="turtle2").name == "turtle2"
    assert world.call(Spawn, "/spawn", x=1.0, y=2.0).name == "turtle3"
    assert world.call(Spawn, "/spawn", name="turtle2").name == ""
    assert world.call(Spawn, "/spawn", name="no good").name == ""
    assert world.call(Spawn, "/spawn", name="{x}").name == ""
    assert sorted(world.sim.world.turtles) == ["turtle1", "turtle2", "turtle3"]
    world.call(Kill, "/kill", name="turtle2")
    world.call(Kill, "/kill", name="turtle2")
    world.call(Empty, "/clear")
    world.call(Empty, "/reset")
    logged = lines(capfd)
    assert logged[:3] == [
        "[INFO] Spawning turtle [turtle2] at x=[4.000000], y=[2.000000], theta=[0.500000]",
        "[INFO] Spawning turtle [turtle3] at x=[1.000000], y=[2.000000], theta=[0.000000]",
        "[ERROR] A turtle named [turtle2] already exists",
    ]
    assert logged[3].startswith("[ERROR] Cannot name a turtle [no good]: ")
    assert logged[4].startswith("[ERROR] Cannot name a turtle [{x}]: ")
    assert logged[4].endswith("is invalid: unknown substitution: {x}")
    assert logged[-4:] == [
        "[ERROR] Tried to kill turtle [turtle2], which does not exist",
        "[INFO] Clearing turtlesim.",
        "[INFO] Resetting turtlesim.",
        "[INFO] Spawning turtle [turtle1] at x=[5.544445], y=[5.544445], theta=[0.000000]",
    ]
    assert {
        name
        for name, _ in world.user.get_topic_names_and_types()
        if "turtle" in name and "/_action/" not in name
    } == {"/turtle1/cmd_vel", "/turtle1/color_sensor", "/turtle1/pose"}


def test_names_in_requests_do_not_steer_the_terminal(make_world, capfd):
    world = make_world()
    for type_, service in ((Spawn, "/spawn"), (Kill, "/kill")):
        world.call(type_, service, name="turtle\x1b[2J")
    logged = capfd.readouterr().err
    assert r"Cannot name a turtle [turtle\x1b[2J]" in logged
    assert r"Tried to kill turtle [turtle\x1b[2J]" in logged
    assert "\x1b" not in logged


def test_a_crowd_says_why_it_takes_time_to_leave(make_world, monkeypatch, capfd):
    monkeypatch.setattr("turtlesim.turtlesim_node._CROWD", 2)
    world = make_world()
    world.sim.spawn(1.0, 1.0, 0.0, "turtle2")
    lines(capfd)
    rclpy.try_shutdown()
    assert lines(capfd) == ["[INFO] Removing 2 turtles from the graph, which takes a few seconds"]


def test_a_wrong_port_is_said_before_anything_is_announced(monkeypatch, capfd):
    monkeypatch.setenv("TURTLEWIRE_PORT", "abc")
    with pytest.raises(SystemExit, match="TURTLEWIRE_PORT is a port number between 0"):
        main(["turtlesim_node"])
    assert "Starting" not in capfd.readouterr().err


def test_teleports_draw_and_the_colour_sensor_sees_it(world):
    colours = world.listen(Color, "/turtle1/color_sensor")
    poses = world.listen(Pose, "/turtle1/pose")
    world.spin_until(lambda: colours)
    assert colours[0] == Color(r=255, g=255, b=255)
    world.call(SetPen, "/turtle1/set_pen", r=10, g=20, b=30, width=5, off=0)
    world.call(TeleportAbsolute, "/turtle1/teleport_absolute", x=2.0, y=3.0, theta=1.5)
    world.spin_until(lambda: colours[-1] == Color(r=10, g=20, b=30))
    world.call(TeleportRelative, "/turtle1/teleport_relative", linear=1.0, angular=-1.5)
    world.spin_until(lambda: poses[-1].x == 3.0)
    assert (poses[-1].y, poses[-1].theta) == (3.0, 0.0)
    world.call(Empty, "/clear")
    world.spin_until(lambda: colours[-1] == Color(r=255, g=255, b=255))
    world.call(SetPen, "/turtle1/set_pen", off=1)
    world.call(TeleportAbsolute, "/turtle1/teleport_absolute", x=5.0, y=5.0)
    seen = len(colours)
    world.spin_until(lambda: len(colours) > seen + 3)
    assert colours[-1] == Color(r=255, g=255, b=255)


def test_walls_warn_with_the_original_text(world, capfd):
    capfd.readouterr()
    world.talk("/turtle1/cmd_vel").publish(twist(1000.0))
    logged: list[str] = []

    def has_warned() -> bool:
        logged.extend(lines(capfd))
        return bool(logged)

    world.spin_until(has_warned)
    assert logged[0] == "[WARN] Oh no! I hit the wall! (Clamping from [x=21.544445, y=5.544445])"


def test_sideways_only_when_holonomic(world):
    poses = world.listen(Pose, "/turtle1/pose")
    cmd_vel = world.talk("/turtle1/cmd_vel")
    cmd_vel.publish(twist(lateral=1.0))
    world.spin_until(lambda: len(poses) > 3)
    assert poses[-1].y == MIDDLE
    world.sim.set_parameters([Parameter("holonomic", value=True)])
    cmd_vel.publish(twist(lateral=1.0))
    world.spin_until(lambda: poses[-1].y > MIDDLE)
    assert (poses[-1].x, poses[-1].linear_velocity) == (MIDDLE, 1.0)


def test_parameters_have_the_original_defaults_and_ranges(world):
    sim = world.sim
    assert [sim.get_parameter(f"background_{channel}").value for channel in "rgb"] == [69, 86, 255]
    assert sim.get_parameter("holonomic").value is False
    descriptor = sim.describe_parameter("background_g")
    assert descriptor.description == "Green channel of the background color"
    assert [(r.from_value, r.to_value, r.step) for r in descriptor.integer_range] == [(0, 255, 1)]
    (result,) = sim.set_parameters([Parameter("background_r", value=256)])
    assert not result.successful


def test_the_page_shows_the_background_live(make_world, monkeypatch):
    monkeypatch.setenv("TURTLEWIRE_PORT", "0")
    monkeypatch.setenv("TURTLEWIRE_BROWSER", "0")
    world = make_world(headless=False)
    with connect(world.sim._screen.url.replace("http", "ws") + "live", close_timeout=0.2) as page:
        assert json.loads(page.recv(timeout=60))["background"] == [69, 86, 255]
        world.sim.set_parameters([Parameter("background_r", value=200)])
        scenes: list[str] = []

        def look() -> bool:
            with contextlib.suppress(TimeoutError):
                while True:
                    scenes.extend(
                        message for message in [page.recv(timeout=0)] if isinstance(message, str)
                    )
            return bool(scenes)

        world.spin_until(look)
    assert json.loads(scenes[0])["background"] == [200, 86, 255]


def test_names_are_relative_to_the_namespace(make_world):
    world = make_world(namespace="/turtlesim1")
    poses = world.listen(Pose, "/turtlesim1/turtle1/pose")
    world.spin_until(lambda: poses)
    assert world.call(Spawn, "/turtlesim1/spawn").name == "turtle2"


class TestMissingTurtles:
    @pytest.fixture(autouse=True)
    def impatient(self, monkeypatch):
        monkeypatch.setattr("turtlesim.missing_turtles._PATIENCE_S", 0.2)

    def test_the_command_for_a_wanted_turtle_is_shown_until_it_is_there(
        self, make_world, monkeypatch, capfd
    ):
        monkeypatch.setattr("turtlesim.missing_turtles._REMINDER_S", 0.1)
        world = make_world()
        world.listen(Pose, "/turtle2/pose")
        hints = []

        def three_hints():
            hints.extend(line for line in lines(capfd) if "A node waits for turtle2" in line)
            return len(hints) >= 3

        world.spin_until(three_hints)
        world.call(Spawn, "/spawn", x=4.0, y=2.0, name="turtle2")
        assert world.sim._missing._reminder.is_canceled()
        world.call(Kill, "/kill", name="turtle2")
        hints.clear()
        world.spin_until(three_hints)

    def test_a_wanted_turtle_is_named_with_the_command(self, make_world, capfd):
        world = make_world()
        capfd.readouterr()
        world.listen(Pose, "/turtle2/pose")
        world.user.create_publisher(Twist, "/turtle2/cmd_vel", 1)
        world.spin_until(lambda: world.sim._missing.names)
        assert world.sim._missing.names == ("turtle2",)
        (hint,) = lines(capfd)
        assert hint == (
            "[INFO] A node waits for turtle2, and there is no turtle with this name. To add it, "
            "type: "
            'ros2 service call /spawn turtlesim/srv/Spawn "{x: 4.0, y: 2.0, theta: 0.0, name: '
            "'turtle2'}\""
        )
        world.call(Spawn, "/spawn", x=4.0, y=2.0, name="turtle2")
        assert world.sim._missing.names == ()

    def test_in_a_crowd_nobody_is_missed(self, make_world, monkeypatch):
        world = make_world()
        world.listen(Pose, "/turtle2/pose")
        world.spin_until(lambda: world.sim._missing.names == ("turtle2",))
        monkeypatch.setattr("turtlesim.missing_turtles._MOST_TURTLES", 0)
        world.listen(Pose, "/turtle3/pose")
        world.spin_until(lambda: world.sim._missing.names == ())

    def test_topics_without_a_turtle_are_ignored(self, world):
        from turtlesim.missing_turtles import find_missing

        world.user.create_publisher(Twist, "/robot/cmd_vel", 1)
        world.user.create_subscription(Pose, "/elsewhere/turtle7/pose", print, 1)
        world.user.create_subscription(Twist, "/turtle8/pose", print, 1)
        world.user.create_publisher(Twist, "/turtle9/cmd_vel", 1)
        endpoints = world.sim.context.wire.graph.endpoints()
        assert find_missing(endpoints, "/", ["turtle1"]) == ("turtle9",)
        assert find_missing(endpoints, "/elsewhere", []) == ("turtle7",)
        assert find_missing(endpoints, "/", ["turtle9", "turtle1"]) == ()


def test_mimic_does_what_the_other_does(world):
    from turtlesim.mimic import MimicNode

    world.call(Spawn, "/spawn", x=2.0, y=2.0, name="follower")
    rules = "-r input/pose:=/turtle1/pose -r output/cmd_vel:=/follower/cmd_vel"
    mimic = MimicNode(cli_args=["--ros-args", *rules.split()])
    world.executor.add_node(mimic)
    poses = world.listen(Pose, "/follower/pose")
    world.talk("/turtle1/cmd_vel").publish(twist(1.0, 0.5))
    world.spin_until(
        lambda: poses and (poses[-1].linear_velocity, poses[-1].angular_velocity) == (1.0, 0.5)
    )
    mimic.destroy_node()


class TestRotateAbsolute:
    @pytest.fixture
    def client(self, world):
        client = ActionClient(world.user, RotateAbsolute, "/turtle1/rotate_absolute")
        world.spin_until(client.server_is_ready)
        yield client
        client.destroy()

    def send(self, world, client, theta: float, feedback: list | None = None):
        """The accepted goal's handle."""
        callback = (
            None
            if feedback is None
            else lambda message: feedback.append(message.feedback.remaining)
        )
        future = client.send_goal_async(
            RotateAbsolute.Goal(theta=theta), feedback_callback=callback
        )
        world.spin_until(future.done)
        return future.result()

    def result(self, world, handle) -> tuple[int, float]:
        future = handle.get_result_async()
        world.spin_until(future.done)
        return future.result().status, future.result().result.delta

    def test_succeeds_with_feedback_every_tick(self, world, client, capfd):
        poses = world.listen(Pose, "/turtle1/pose")
        feedback: list[float] = []
        handle = self.send(world, client, 0.5, feedback)
        status, delta = self.result(world, handle)
        assert status == GoalStatus.STATUS_SUCCEEDED
        assert delta == pytest.approx(-0.496, abs=0.02)
        assert poses[-1].theta == pytest.approx(0.5, abs=0.02)
        steps = [a - b for a, b in itertools.pairwise(feedback)]
        assert feedback[0] == 0.5
        assert steps == pytest.approx([0.016] * len(steps), abs=1e-6)
        assert lines(capfd)[-1] == "[INFO] Rotation goal completed successfully"

    def test_a_velocity_command_aborts_it(self, world, client, capfd):
        feedback: list[float] = []
        handle = self.send(world, client, 3.0, feedback)
        world.spin_until(lambda: len(feedback) > 5)
        world.talk("/turtle1/cmd_vel").publish(twist(1.0))
        status, delta = self.result(world, handle)
        assert status == GoalStatus.STATUS_ABORTED
        assert delta < -0.05
        assert (
            lines(capfd)[-1]
            == "[WARN] Velocity command received during rotation goal. Aborting goal"
        )

    def test_a_new_goal_aborts_the_old_one(self, world, client, capfd):
        first = self.send(world, client, 3.0)
        second = self.send(world, client, 0.1)
        assert self.result(world, first)[0] == GoalStatus.STATUS_ABORTED
        assert self.result(world, second)[0] == GoalStatus.STATUS_SUCCEEDED
        assert (
            "[WARN] Rotation goal received before a previous goal finished. Aborting previous goal"
            in lines(capfd)
        )

    def test_cancel(self, world, client, capfd):
        feedback: list[float] = []
        handle = self.send(world, client, -3.0, feedback)
        world.spin_until(lambda: len(feedback) > 5)
        canceling = handle.cancel_goal_async()
        world.spin_until(canceling.done)
        status, delta = self.result(world, handle)
        assert (status, delta > 0) == (GoalStatus.STATUS_CANCELED, True)
        assert lines(capfd)[-1] == "[INFO] Rotation goal canceled"
        poses = world.listen(Pose, "/turtle1/pose")
        world.spin_until(lambda: len(poses) > 2)
        assert poses[-1].angular_velocity == 0.0

    def test_killing_the_turtle_ends_its_goal(self, world, client):
        handle = self.send(world, client, 3.0)
        result = handle.get_result_async()
        world.call(Kill, "/kill", name="turtle1")
        assert world.sim.world.turtles == {}
        world.spin_until(lambda: not client.server_is_ready())
        assert not result.done() or result.result().status == GoalStatus.STATUS_ABORTED

    def test_a_heading_that_is_not_finite_is_rejected(self, world, client):
        assert not self.send(world, client, math.nan).accepted


class TestPace:
    @pytest.fixture
    def page(self, make_world, monkeypatch):
        """A simulator, and a page of it."""
        monkeypatch.setenv("TURTLEWIRE_PORT", "0")
        monkeypatch.setenv("TURTLEWIRE_BROWSER", "0")
        world = make_world(headless=False)
        url = world.sim._screen.url.replace("http", "ws") + "live"
        with connect(url, close_timeout=0.2) as page:
            yield world, page

    def test_the_speed_is_a_parameter_from_its_first_use_on(self, page):
        world, browser = page
        assert not world.sim.has_parameter("speed")
        browser.send('{"type": "speed", "factor": 0}')
        world.spin_until(lambda: world.sim.has_parameter("speed"))
        assert world.sim.get_parameter("speed").value == 0.0
        for wrong in (-1.0, 2000.0):
            (result,) = world.sim.set_parameters([Parameter("speed", value=wrong)])
            assert not result.successful
        world.sim.set_parameters([Parameter("speed", value=2.5)])
        assert world.sim._scene().speed == 2.5

    def test_in_a_pause_nothing_moves_and_no_pose_comes(self, page):
        world, browser = page
        poses = world.listen(Pose, "/turtle1/pose")
        world.spin_until(lambda: poses)
        world.talk("/turtle1/cmd_vel").publish(twist(linear=2.0))
        world.spin_until(lambda: poses[-1].linear_velocity == 2.0)
        browser.send('{"type": "speed", "factor": 0}')
        world.spin_until(lambda: world.sim.has_parameter("speed"))
        turtle = world.sim.world.turtles["turtle1"]
        place, heard = turtle.x, len(poses)
        browser.send('{"type": "teleport", "turtle": "turtle1", "x": 3, "y": 4, "theta": 0}')
        world.spin_until(lambda: turtle.x == 3.0)  # pages are obeyed
        assert len(poses) <= heard + 1  # one may have been on its way
        assert place < MIDDLE + 2.0
        browser.send('{"type": "speed", "factor": 4}')
        world.spin_until(lambda: poses[-1].linear_velocity == 0.0 and len(poses) > heard + 10)
        # The command lasts a simulated second, the pause not counted, and ticks are not lost.
        assert poses[-1].x - 3.0 + place - MIDDLE == pytest.approx(2.0, abs=0.3)

    def test_a_page_sets_pen_and_background_as_a_node_would(self, page):
        world, browser = page
        browser.send('{"type": "background", "r": 1, "g": 2, "b": 3}')
        browser.send(
            '{"type": "pen", "turtle": "turtle1", "r": 9, "g": 8, "b": 7, "width": 5, "off": false}'
        )
        turtle = world.sim.world.turtles["turtle1"]
        world.spin_until(lambda: turtle.pen == (9, 8, 7, 5))
        values = [world.sim.get_parameter(f"background_{channel}").value for channel in "rgb"]
        assert values == [1, 2, 3]
        assert world.sim._scene().pens == (("#090807", 5, True),)
        world.call(SetPen, "/turtle1/set_pen", r=1, g=1, b=1, width=2, off=1)
        assert world.sim._screen._picture.scene.pens == (("#090807", 5, False),)


def test_a_faster_simulation_has_its_speed_as_a_parameter(make_world):
    world = make_world(speed=8.0)
    assert world.sim.get_parameter("speed").value == 8.0
    clocks = world.listen(Clock, "/clock")
    world.spin_until(lambda: len(clocks) > 2)
    world.sim.set_parameters([Parameter("speed", value=0.0)])
    world.executor.spin_once(timeout_sec=0.1)
    heard = clocks[-1]
    for _ in range(10):
        world.executor.spin_once(timeout_sec=0.1)
    assert clocks[-1].clock.nanosec - heard.clock.nanosec <= TICK_NS  # one may be on its way
    world.sim.set_parameters([Parameter("speed", value=1.0)])
    world.spin_until(lambda: clocks[-1].clock.nanosec > heard.clock.nanosec + 3 * TICK_NS)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("--haedless", "turtlesim_node: ignored: --haedless. Did you mean: --headless\n"),
        ("--headles", "turtlesim_node: ignored: --headles. Did you mean: --headless\n"),
        ("--sped=2", "turtlesim_node: ignored: --sped=2. Did you mean: --speed\n"),
        ("word", "turtlesim_node: ignored: word. See --help\n"),
        ("--headless --ros-args -r __node:=sim", ""),
    ],
)
def test_an_option_that_it_does_not_know_is_ignored_and_named(words, said, capsys):
    options = parse_options(["turtlesim_node", *words.split()])
    assert options.headless == ("--headless" in words)
    assert capsys.readouterr() == ("", said)
