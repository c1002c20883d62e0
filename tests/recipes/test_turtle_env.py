"""examples/gym_turtlesim keeps Gymnasium's rules, and its episodes can be repeated.

The arm of examples/mujoco_robot moves, and publishes the poses of its bodies.
"""

import importlib.util
import math
import sys
from itertools import islice, pairwise

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from tests.places import EXAMPLES

from turtlewire import geometry

NAME = "turtle_env:TurtleGoal-v0"


@pytest.fixture
def make(monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLES / "gym_turtlesim"))
    environments = []

    def start():
        environments.append(gymnasium.make(NAME))
        return environments[-1]

    yield start
    for environment in environments:
        environment.close()


def episode(environment, seed):
    """Drive at random, and return all observations and rewards."""
    observation, _ = environment.reset(seed=seed)
    environment.action_space.seed(seed)
    found = [(*observation.tolist(), 0.0)]
    ended = False
    while not ended:
        action = environment.action_space.sample()
        observation, reward, reached, too_long, _ = environment.step(action)
        found.append((*observation.tolist(), reward))
        ended = reached or too_long
    return found


def test_the_environment_passes_gymnasiums_checks(make):
    check_env(make().unwrapped)  # warnings are errors


def test_the_same_seed_gives_the_same_episode(make):
    one, other = make(), make()
    first = episode(one, 7)
    assert episode(other, 7) == first
    assert episode(one, 7) == first  # also after another episode
    assert episode(one, 8) != first


def test_an_episode_ends_at_the_goal(make):
    environment = make()
    (ahead, left), _ = environment.reset(seed=1)
    distance, reached, too_long = math.hypot(ahead, left), False, False
    while not reached and not too_long:
        turn = np.clip(math.atan2(left, ahead), -1.0, 1.0)
        (ahead, left), reward, reached, too_long, _ = environment.step([1.0, turn])
        distance -= reward + 0.01  # the cost of a step
    assert reached
    assert math.hypot(ahead, left) < 0.5
    assert distance == pytest.approx(math.hypot(ahead, left), abs=1e-5)


def test_a_turtle_that_stands_still_ends_after_300_steps(make):
    environment = make()
    start, _ = environment.reset(seed=1)
    for step in range(1, 301):
        observation, reward, reached, too_long, _ = environment.step([0.0, 0.0])
        assert np.array_equal(observation, start)
        assert (reward, reached, too_long) == (-0.01, False, step == 300)


def test_actions_out_of_range_are_limited(make):
    one, other = make().unwrapped, make().unwrapped
    one.reset(seed=3)
    other.reset(seed=3)
    assert np.array_equal(one.step([5.0, -9.0])[0], other.step([1.0, -1.0])[0])


def test_several_environments_run_side_by_side(monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLES / "gym_turtlesim"))
    environments = gymnasium.make_vec(NAME, num_envs=4)
    observations, _ = environments.reset(seed=1)
    assert observations.shape == (4, 2)
    assert len({tuple(each) for each in observations.tolist()}) == 4
    environments.close()


MINUTE_NS = 60_000_000_000
COMMANDS = "/forward_position_controller/commands"
JOINTS = ["turn", "shoulder", "elbow"]
LIBRARIES = "rendering needs EGL (Debian: apt install libegl1 libgl1-mesa-dri)"

OWN_MODEL = """
<mujoco>
  <worldbody>
    <body name="slider"><joint name="rail" type="slide" axis="1 0 0"/><geom size="0.1"/></body>
    <body pos="0 0 1"><joint type="ball"/><geom size="0.1"/></body>
    <body name="hand" mocap="true" pos="0 1 0" quat="0 0 0 1"/>
    <body name="shelf" pos="0 0 2"><geom size="0.1"/></body>
  </worldbody>
</mujoco>
"""


@pytest.fixture
def program(monkeypatch):
    """The robot's module."""
    monkeypatch.setenv("MUJOCO_GL", "disable")
    spec = importlib.util.spec_from_file_location(
        "mujoco_robot", EXAMPLES / "mujoco_robot" / "mujoco_robot.py"
    )
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def nanoseconds(stamp):
    return stamp.sec * 1_000_000_000 + stamp.nanosec


def command(net, angles):
    """Command the joints, and return the first state in which they are there."""
    states = net.subscribe("/joint_states", "sensor_msgs/msg/JointState")
    publisher = net.publisher(COMMANDS, "std_msgs/msg/Float64MultiArray")
    assert publisher.wait_for_subscribers(timeout_ns=MINUTE_NS)
    publisher.publish(data=angles)
    return next(state for state in states if np.allclose(state.position, angles, atol=1e-4))


def test_the_hand_goes_to_the_pose_of_the_commanded_angles(robot, net):
    robot(camera="false")
    transforms = net.transforms()
    turn, shoulder, elbow = angles = [0.5, 0.6, 1.2]
    state = command(net, angles)
    assert list(state.name) == JOINTS
    stamp = nanoseconds(state.header.stamp)
    hand = transforms.lookup_transform("base_link", "hand", stamp, timeout_ns=MINUTE_NS)
    ahead = 0.3 * math.sin(shoulder) + 0.25 * math.sin(shoulder + elbow)
    up = 0.05 + 0.06 + 0.3 * math.cos(shoulder) + 0.25 * math.cos(shoulder + elbow)
    place = (ahead * math.cos(turn), ahead * math.sin(turn), up)
    assert hand.translation == pytest.approx(place, abs=1e-3)
    rotation = geometry.quaternion_from_euler([0.0, shoulder + elbow, turn])
    assert abs(np.dot(hand.rotation, rotation)) == pytest.approx(1.0, abs=1e-6)


def test_transforms_keep_the_rotation_of_mujoco(program):
    wxyz = np.array([0.1, 0.5, -0.3, 0.8])
    wxyz /= np.linalg.norm(wxyz)
    matrix = np.zeros(9)
    program.mujoco.mju_quat2Mat(matrix, wxyz)
    made = program.transform("world", "cube", np.array([1.0, 2.0, 3.0]), wxyz)
    rotation = made.transform.rotation
    xyzw = [rotation.x, rotation.y, rotation.z, rotation.w]
    assert np.allclose(geometry.matrix_from_quaternion(xyzw), matrix.reshape(3, 3))
    assert (made.header.frame_id, made.child_frame_id) == ("world", "cube")
    assert made.transform.translation.y == 2.0


def test_the_clock_has_the_stamps_of_the_states(robot, net):
    robot(camera="false")
    clock = net.subscribe("/clock", "rosgraph_msgs/msg/Clock")
    states = net.subscribe("/joint_states", "sensor_msgs/msg/JointState")
    times = [nanoseconds(message.clock) for message in islice(clock, 5)]
    assert all(earlier < later for earlier, later in pairwise(times))
    assert all(time % 20_000_000 == 0 for time in times)
    assert nanoseconds(next(states).header.stamp) % 20_000_000 == 0


def test_the_camera_sees_the_cube_below_the_middle(robot, net):
    if "no camera image" in robot().text:
        pytest.skip(LIBRARIES)
    transforms = net.transforms()
    settled = nanoseconds(command(net, [0.0, 0.2, 2.0]).header.stamp)
    images = net.subscribe("/camera/image_raw", "sensor_msgs/msg/Image")
    infos = net.subscribe("/camera/camera_info", "sensor_msgs/msg/CameraInfo")
    image = next(each for each in images if nanoseconds(each.header.stamp) > settled)
    info = next(infos)
    assert (image.width, image.height, image.encoding, image.step) == (320, 240, "rgb8", 960)
    assert (info.width, info.height, info.header.frame_id) == (320, 240, image.header.frame_id)
    pixels = np.frombuffer(bytes(image.data), np.uint8).reshape(240, 320, 3).astype(int)
    rows, columns = np.nonzero(pixels[..., 0] > 2 * pixels[..., 1] + 50)
    # The calibration and the transforms say where the middle of the cube is in the image.
    cube = transforms.lookup_transform(image.header.frame_id, "cube", timeout_ns=MINUTE_NS)
    column, row, depth = np.reshape(info.k, (3, 3)) @ cube.translation
    assert (columns.mean(), rows.mean()) == pytest.approx((column / depth, row / depth), abs=8)
    assert rows.mean() > 120


def test_a_computer_without_opengl_gets_all_but_images(robot, net):
    started = robot({"MUJOCO_GL": "disable"})
    assert "no camera image: MuJoCo cannot render with MUJOCO_GL=disable" in started.text
    assert "apt install libegl1" in started.text
    assert "joints 3, actuators 3, camera no" in started.text
    assert list(next(net.subscribe("/joint_states")).name) == JOINTS
    assert "/camera/image_raw" not in net.topics()


def test_a_command_of_the_wrong_length_is_ignored(robot, net):
    started = robot(camera="false")
    publisher = net.publisher(COMMANDS, "std_msgs/msg/Float64MultiArray")
    assert publisher.wait_for_subscribers(timeout_ns=MINUTE_NS)
    publisher.publish(data=[1.0])
    started.wait_for("expected 3 numbers, one for each actuator, got 1; the command is ignored")


def test_a_model_of_your_own_is_published(robot, net, tmp_path):
    model = tmp_path / "own.xml"
    model.write_text(OWN_MODEL)
    started = robot(model=model)
    assert "bodies 4, joints 1, actuators 0, camera no" in started.text
    transforms = net.transforms()
    assert list(next(net.subscribe("/joint_states")).name) == ["rail"]
    lookup = transforms.lookup_transform
    hand = lookup("world", "hand", timeout_ns=MINUTE_NS)
    assert (hand.translation, hand.rotation) == ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0, 0.0))
    assert lookup("world", "body_2", timeout_ns=MINUTE_NS).translation == (0.0, 0.0, 1.0)
    assert lookup("world", "shelf", timeout_ns=MINUTE_NS).translation == (0.0, 0.0, 2.0)


def test_a_missing_model_is_named(run):
    words = ["--ros-args", "-p", "model:=none.xml"]
    program = run(sys.executable, EXAMPLES / "mujoco_robot" / "mujoco_robot.py", *words)
    assert program.wait() == 1
    assert "none.xml" in program.text
    assert "Traceback" not in program.text


def test_a_model_without_joints_is_published(robot, net, tmp_path):
    model = tmp_path / "still.xml"
    model.write_text("<mujoco><worldbody><body name='box' pos='1 0 0'/></worldbody></mujoco>")
    robot(model=model)
    box = net.transforms().lookup_transform("world", "box", timeout_ns=MINUTE_NS)
    assert box.translation == (1.0, 0.0, 0.0)
    assert not next(net.subscribe("/joint_states")).name
