"""Each lesson of our tutorial package after the follow demo, launched for real.

What turtle2 does, and a clean end.

The files of the lesson in the browser, unchanged, by `ros2 launch` and on the wire.
"""

import math
import shutil

import pytest
from tests.places import LESSONS, ROOT, ROS2

from turtle_lesson.lesson import load_lesson
from turtlewire import Buffer
from turtlewire.tf.listener import TransformListener

LONG_NS = 60_000_000_000


@pytest.fixture
def lesson(ros2):
    """Starts a launch file of the package.

    At the end Ctrl-C must end all of its processes cleanly.
    """
    started = []

    def start(name, *arguments, processes):
        launch = ros2("launch", "learning_tf2_py", name, *arguments)
        started.append((launch, processes))
        return launch

    yield start
    for launch, processes in started:
        launch.end(processes)


def carrot_seen_from_turtle1(turtles):
    with TransformListener(buffer := Buffer(), turtles.node, context=turtles.context):
        return buffer.lookup_transform("turtle1", "carrot1", timeout_ns=LONG_NS).translation


def away(turtles, x, y):
    """Return the distance of turtle2 from a point [m]."""
    turtle2 = turtles.poses.get("turtle2")
    return math.inf if turtle2 is None else math.dist((turtle2.x, turtle2.y), (x, y))


def test_the_fixed_carrot(lesson, turtles):
    lesson("turtle_tf2_fixed_frame_demo.launch.py", processes=5)
    assert carrot_seen_from_turtle1(turtles) == (0.0, 2.0, 0.0)
    middle = 499 / 90
    turtles.wait_for(lambda: away(turtles, middle, middle + 2.0) < 1.8)  # nearer than turtle1 is


@pytest.mark.slow
def test_the_swinging_carrot(lesson, turtles):
    lesson("turtle_tf2_dynamic_frame_demo.launch.py", processes=5)
    assert math.hypot(*carrot_seen_from_turtle1(turtles)) == pytest.approx(10.0)
    turtles.wait_for(
        lambda: "turtle2" in turtles.poses and turtles.poses["turtle2"].linear_velocity > 2.0
    )  # never nearer than that


@pytest.mark.parametrize("waiting", ["blocking", pytest.param("async", marks=pytest.mark.slow)])
def test_a_listener_that_waits(lesson, turtles, waiting):
    launch = lesson("turtle_tf2_waiting_demo.launch.py", f"waiting:={waiting}", processes=4)
    # The present is newer than the latest transform: a lookup that does not wait never succeeds.
    turtles.wait_for(lambda: len(turtles.poses) == 2 and turtles.distance() < 2.0)
    assert f"turtle_tf2_{waiting}_listener-4" in launch.text


@pytest.mark.slow
def test_time_travel(lesson, turtles):
    lesson("turtle_tf2_time_travel_demo.launch.py", processes=4)
    turtles.wait_for(lambda: len(turtles.poses) == 2 and turtles.distance() < 1.0)


@pytest.mark.slow
def test_a_target_is_an_argument(lesson, turtles, run):
    """The launch file of the demo with another target, and the carrot from a terminal of its
    own.
    """
    lesson("turtle_tf2_demo.launch.py", "target_frame:=carrot1", processes=4)
    static = ["--x", "-2", "--frame-id", "turtle1", "--child-frame-id", "carrot1"]
    run(ROS2, "run", "tf2_ros", "static_transform_publisher", *static)
    middle = 499 / 90
    turtles.wait_for(lambda: away(turtles, middle - 2.0, middle) < 1.0)


@pytest.mark.slow
def test_the_demo_speaks_the_interfaces_of_kilted(ros2):
    """The same sources, which import turtlesim's interfaces by their former names."""
    launch = ros2("launch", "learning_tf2_py", "turtle_tf2_demo.launch.py", ROS_DISTRO="kilted")
    launch.wait_for("Successfully spawned turtle2")
    topic = ("/turtle2/pose", "turtlesim_msgs/msg/Pose")
    echo = ros2("topic", "echo", "--once", *topic, ROS_DISTRO="kilted")
    assert echo.wait() == 0
    assert echo.text.startswith("x: ")
    launch.end(4)


def test_the_arguments_are_shown_and_checked(ros2):
    demo = ("learning_tf2_py", "turtle_tf2_waiting_demo.launch.py")
    shown = ros2("launch", *demo, "-s")
    assert shown.wait() == 0
    assert "'waiting':" in shown.text
    assert "(default: 'blocking')" in shown.text
    wrong = ros2("launch", *demo, "waiting:=never")
    assert wrong.wait() == 1
    assert "['blocking', 'async']" in wrong.text


VERBATIM = ROOT / "tests" / "tutorial" / "verbatim" / "learning_tf2_py"
SPAWN = "{x: 4.0, y: 2.0, theta: 0.0, name: 'turtle2'}"


@pytest.mark.slow
def test_a_solution_of_the_lesson_does_the_same_when_it_is_launched(
    run, workspace, turtles, tmp_path
):
    package = tmp_path / "learning_tf2_py"
    shutil.copytree(VERBATIM, package, ignore=shutil.ignore_patterns("__pycache__"))
    for name, text in load_lesson(LESSONS / "listener").solution().items():
        (package / "learning_tf2_py" / name).write_text(text, encoding="utf-8")
    launch = run(
        ROS2, "launch", package.name, "turtle_tf2_demo.launch.py", environment=workspace(package)
    )
    launch.wait_for("Spawning turtle")
    spawn = run(ROS2, "service", "call", "/spawn", "turtlesim/srv/Spawn", SPAWN)
    assert spawn.wait() == 0, spawn.text

    def keeps_its_distance():
        follower = turtles.poses.get("turtle2")
        return (
            follower is not None
            and abs(turtles.distance() - 1.0) < 0.15
            and abs(follower.linear_velocity) < 0.1
        )

    turtles.wait_for(keeps_its_distance)
    launch.end()
