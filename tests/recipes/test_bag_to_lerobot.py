"""examples/bag_to_lerobot writes the states, commands and images of a bag at the same moments."""

import importlib
import io
import json
import subprocess
import sys
from bisect import bisect_right
from types import SimpleNamespace

import av
import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest
from PIL import Image as Picture
from tests.bags import SECOND, START, stamped
from tests.places import EXAMPLES

from turtlewire.bag import BagWriter, open_bag
from turtlewire.errors import BagError
from turtlewire.msg import get_message

FPS = 20
PARTS = ("--fps", FPS, "--pose", "base_link:hand", "--action", "/commands:data")
CAMERA = ("--camera", "top=/camera/image_raw")


@pytest.fixture
def recipe(monkeypatch):
    """The modules of the recipe."""
    monkeypatch.syspath_prepend(str(EXAMPLES / "bag_to_lerobot"))
    names = ("aligned", "bag_to_lerobot", "dataset", "demo_bag", "images")
    return SimpleNamespace(**{name: importlib.import_module(name) for name in names})


@pytest.fixture
def demo(recipe, tmp_path):
    """A bag of the recipe: 2 s of an arm, seed 3."""
    recipe.demo_bag.write_demo_bag(str(tmp_path / "demo"), seconds=2.0, seed=3)
    return tmp_path / "demo"


@pytest.fixture
def convert(recipe, tmp_path):
    def run(*words, status=0):
        found = recipe.bag_to_lerobot.main([str(word) for word in (*words, "-o", tmp_path / "set")])
        assert found == status
        return tmp_path / "set"

    return run


def frames_of(path):
    with av.open(path) as file:
        return [(frame.time, frame.to_ndarray(format="rgb24")) for frame in file.decode(video=0)]


def joint_state(stamp, **positions):
    made = get_message("sensor_msgs/msg/JointState")(
        name=list(positions), position=list(positions.values())
    )
    return stamped(made, stamp)


def twist(speed):
    made = get_message("geometry_msgs/msg/Twist")()
    made.linear.x, made.angular.z = speed, -speed
    return made


def image(encoding, pixels):
    pixels = np.ascontiguousarray(pixels)
    step = pixels[0].nbytes
    kind = get_message("sensor_msgs/msg/Image")
    height, width = pixels.shape[:2]
    data = pixels.tobytes()
    return kind(height=height, width=width, encoding=encoding, step=step, data=data)


def test_rows_hold_what_was_so_at_their_time(recipe, demo, convert):
    folder = convert(demo, *PARTS, *CAMERA, "--task", "Follow")
    rows = pq.read_table(folder / "data/chunk-000/file-000.parquet").to_pydict()
    truth = list(recipe.demo_bag.angles_over_time(2.0, 3))
    first = 7  # ms of the first command
    count = len(rows["index"])
    assert count == (1967 - first) * FPS // 1000 + 1  # until the last image
    issued = [tick for tick, _, _ in truth if tick % 50 == 7]
    pictures = [tick for tick, _, _ in truth if tick * 30 % 1000 < 30]
    frames = frames_of(folder / "videos/observation.images.top/chunk-000/file-000.mp4")
    assert len(frames) == count
    for k in range(count):
        tick = first + k * 1000 // FPS
        angles = truth[tick][2]
        state, action = rows["observation.state"][k], rows["action"][k]
        np.testing.assert_allclose(state[:2], angles, atol=2e-3)
        np.testing.assert_allclose(state[2:4], recipe.demo_bag.hand(angles), atol=2e-3)
        assert abs(np.linalg.norm(state[5:])) == pytest.approx(1.0, abs=1e-6)
        commanded = issued[bisect_right(issued, tick) - 1]
        np.testing.assert_allclose(action, truth[commanded][1], atol=1e-6)
        seen = truth[pictures[bisect_right(pictures, tick) - 1]][2]
        at, pixels = frames[k]
        assert at == pytest.approx(k / FPS) == pytest.approx(rows["timestamp"][k])
        difference = np.abs(pixels.astype(float) - recipe.demo_bag.picture(seen))
        assert difference.mean() < 2.0


def test_the_folder_has_the_layout_of_lerobot(demo, recipe, convert, tmp_path, capsys):
    other = tmp_path / "other"
    recipe.demo_bag.write_demo_bag(str(other), seconds=1.0, seed=4)
    folder = convert(demo, other, *PARTS, *CAMERA, "--task", "Follow", "--robot", "arm")
    assert capsys.readouterr().out == f"{demo}: 40 rows, 1.9 s\n{other}: 20 rows, 0.9 s\n"
    info = json.loads((folder / "meta/info.json").read_text())
    assert (info["codebase_version"], info["robot_type"], info["fps"]) == ("v3.0", "arm", FPS)
    assert (info["total_episodes"], info["total_frames"], info["total_tasks"]) == (2, 60, 1)
    features = info["features"]
    assert features["observation.state"]["names"][:3] == ["shoulder.pos", "elbow.pos", "hand.x"]
    assert features["action"] == {"dtype": "float32", "shape": [2], "names": ["data[0]", "data[1]"]}
    assert features["observation.images.top"]["shape"] == [120, 160, 3]
    episodes = pd.read_parquet(folder / "meta/episodes")
    assert episodes["dataset_from_index"].tolist() == [0, 40]
    assert episodes["dataset_to_index"].tolist() == [40, 60]
    for row in episodes.to_dict("records"):
        place = {key: row[f"data/{key}"] for key in ("chunk_index", "file_index")}
        data = pd.read_parquet(folder / info["data_path"].format(**place))
        key = "observation.images.top"
        place = {each: row[f"videos/{key}/{each}"] for each in ("chunk_index", "file_index")}
        video = folder / info["video_path"].format(video_key=key, **place)
        assert len(data) == len(frames_of(video)) == row["length"]
        assert set(data) == features.keys() - {key}
        assert data["index"].iloc[0] == row["dataset_from_index"]
        assert set(data["episode_index"]) == {row["episode_index"]}
        assert row["tasks"].tolist() == ["Follow"]
    tasks = pd.read_parquet(folder / "meta/tasks.parquet")
    assert (tasks.index.tolist(), tasks["task_index"].tolist()) == (["Follow"], [0])
    statistics = json.loads((folder / "meta/stats.json").read_text())
    assert np.shape(statistics["observation.images.top"]["mean"]) == (3, 1, 1)
    assert statistics["index"]["max"] == [59]
    whole = pd.read_parquet(folder / "data")
    np.testing.assert_allclose(statistics["action"]["mean"], np.mean(list(whole["action"]), axis=0))


def test_commands_without_a_stamp_follow_the_clock_of_the_joints(recipe, tmp_path):
    """In a simulation, messages are recorded at wall time and stamped with simulated time."""
    with BagWriter(tmp_path / "simulated") as writer:
        for k in range(100):
            now = START + k * 20_000_000  # twice as slow as the simulation
            writer.write("/joint_states", joint_state(k * 40_000_000, a=0.1 * k), now)
            if k % 10 == 0:
                writer.write("/cmd_vel", twist(float(k)), now + 1_000_000)
    wanted = recipe.aligned.Wanted(25, "/joint_states", "/cmd_vel", ["linear.x", "angular.z"])
    with open_bag(tmp_path / "simulated") as bag:
        rows = recipe.aligned.align(bag, wanted)
    assert rows.stamps_ns[0] == 2_000_000
    assert rows.stamps_ns[-1] <= 99 * 40_000_000
    since = (rows.stamps_ns - 2_000_000) // 400_000_000
    np.testing.assert_array_equal(rows.action[:, 0], 10 * since)
    np.testing.assert_array_equal(rows.action[:, 1], -10 * since)
    np.testing.assert_allclose(rows.state[:, 0], rows.stamps_ns * 0.1 / 40_000_000)
    assert rows.action_names == ["linear.x", "angular.z"]


def test_a_static_pose_alone_lasts_as_long_as_the_commands(recipe, demo):
    wanted = recipe.aligned.Wanted(20, "", "/commands", ["data"], [("base_link", "camera")])
    with open_bag(demo) as bag:
        rows = recipe.aligned.align(bag, wanted)
    assert rows.stamps_ns.tolist() == [START + 7_000_000 + k * SECOND // 20 for k in range(40)]
    assert set(map(tuple, rows.state.tolist())) == {(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0)}


def test_joints_of_several_publishers_are_columns_of_their_own(recipe, tmp_path):
    with BagWriter(tmp_path / "two") as writer:
        for k in range(10):
            now = START + k * SECOND
            writer.write("/joint_states", joint_state(now, a=float(k), b=2.0 * k), now)
            writer.write("/joint_states", joint_state(now + SECOND // 2, grip=3.0 * k), now + 5)
            writer.write("/cmd_vel", twist(1.0), now)
        writer.write("/joint_states", joint_state(START), START)  # no joints
    wanted = recipe.aligned.Wanted(1, "/joint_states", "/cmd_vel", ["linear"])
    with open_bag(tmp_path / "two") as bag:
        rows = recipe.aligned.align(bag, wanted)
    assert rows.state_names == ["a.pos", "b.pos", "grip.pos"]
    assert rows.action_names == ["linear[0]", "linear[1]", "linear[2]"]
    expected = [[k + 0.5, 2 * k + 1.0, 3.0 * k] for k in range(9)]
    np.testing.assert_allclose(rows.state, expected)


def test_a_joint_is_one_column_in_any_order_of_the_names(recipe, tmp_path):
    with BagWriter(tmp_path / "mixed") as writer:
        for k in range(10):
            now = START + k * SECOND
            state = {"a": float(k), "b": 2.0 * k}
            state = state if k % 2 else dict(reversed(state.items()))
            writer.write("/joint_states", joint_state(now, **state), now)
            wheel = get_message("sensor_msgs/msg/JointState")(name=["wheel"], velocity=[1.0])
            writer.write("/joint_states", stamped(wheel, now), now)  # it has no position
            writer.write("/cmd_vel", twist(1.0), now)
    wanted = recipe.aligned.Wanted(2, "/joint_states", "/cmd_vel", ["linear.x"])
    with open_bag(tmp_path / "mixed") as bag:
        rows = recipe.aligned.align(bag, wanted)
    assert rows.state_names == ["b.pos", "a.pos"]
    np.testing.assert_allclose(rows.state, [[k, k / 2] for k in range(19)])


@pytest.mark.parametrize(
    ("names", "positions", "text"),
    [
        (["a", "b"], [1.0], "/joint_states has 2 names, but 1 positions"),
        ([], [1.0], "/joint_states has 0 names, but 1 positions"),
        (["a"], [], "/joint_states has no positions of joints"),
    ],
)
def test_joint_states_without_a_position_for_each_are_named(
    recipe, tmp_path, names, positions, text
):
    state = get_message("sensor_msgs/msg/JointState")(name=names, position=positions)
    with BagWriter(tmp_path / "odd") as writer:
        writer.write("/joint_states", stamped(state, START), START)
    with open_bag(tmp_path / "odd") as bag, pytest.raises(ValueError, match=text):
        recipe.aligned.joint_signals(bag, "/joint_states")


@pytest.mark.parametrize(
    ("counts", "text"), [([1, 3], "data has 1 to 3 numbers"), ([0, 0], "data has no numbers")]
)
def test_commands_that_are_not_columns_are_named(recipe, tmp_path, counts, text):
    with BagWriter(tmp_path / "odd") as writer:
        for count in counts:
            command = get_message("std_msgs/msg/Float64MultiArray")(data=[1.0] * count)
            writer.write("/commands", command, START)
    wanted = recipe.aligned.Wanted(2, "", "/commands", ["data"])
    with open_bag(tmp_path / "odd") as bag, pytest.raises(ValueError, match=text):
        recipe.aligned.command_signal(bag, wanted, None)


def test_the_latest_or_the_nearest_image_is_chosen(recipe):
    stamps, steps = np.array([0, 10, 20]), np.array([0, 4, 6, 10, 17, 25])
    assert recipe.aligned.last_before(stamps, steps).tolist() == [0, 0, 0, 1, 1, 2]
    assert recipe.aligned.nearest_to(stamps, steps).tolist() == [0, 0, 1, 1, 2, 2]
    assert recipe.aligned.nearest_to(stamps[:1], steps).tolist() == [0] * 6


@pytest.mark.parametrize("encoding", ["rgb8", "bgr8", "rgba8", "bgra8", "mono8", "jpeg"])
def test_encodings_become_rgb(recipe, tmp_path, monkeypatch, encoding):
    monkeypatch.setattr(recipe.images, "WINDOW", SECOND)  # several windows
    red = np.full((4, 6, 3), (200, 40, 90), np.uint8)
    grey = np.full((4, 6), 70, np.uint8)
    alpha = np.full((4, 6, 1), 9, np.uint8)
    made = {
        "bgr8": red[..., ::-1],
        "rgba8": np.dstack([red, alpha]),
        "bgra8": np.dstack([red[..., ::-1], alpha]),
        "mono8": grey,
    }.get(encoding, red)
    if encoding == "jpeg":
        file = io.BytesIO()
        Picture.fromarray(red).save(file, "jpeg", quality=100, subsampling=0)
        message = get_message("sensor_msgs/msg/CompressedImage")(
            format=encoding, data=file.getvalue()
        )
    else:
        message = image(encoding, made)
    times = START + np.arange(5) * SECOND // 2
    with BagWriter(tmp_path / "images") as writer:
        for time in times:
            writer.write("/image", stamped(message, int(time)), int(time))
    with open_bag(tmp_path / "images") as bag:
        found = list(recipe.images.images_of(bag, "/image", times[[0, 1, 1, 4]]))
    assert len(found) == 4
    for pixels in found:
        assert pixels.shape == (4, 6, 3)
        colour = (70, 70, 70) if encoding == "mono8" else (200, 40, 90)
        np.testing.assert_allclose(pixels[2, 3].astype(int), colour, atol=3)


def test_an_image_of_odd_size_loses_its_last_row_and_column(recipe, tmp_path):
    pixels = np.zeros((5, 7, 3), np.uint8)
    rows = recipe.aligned.Rows(np.arange(3), np.zeros((3, 1)), ["a"], np.ones((3, 1)), ["b"], {})
    with recipe.dataset.DataSet(tmp_path / "odd", 10, "arm") as data_set:
        data_set.add_episode(rows, "", {"top": iter([pixels] * 3)})
    (video,) = (tmp_path / "odd").glob("videos/*/*/*.mp4")
    assert [frame.shape for _, frame in frames_of(video)] == [(4, 6, 3)] * 3
    table = pq.read_table(tmp_path / "odd/data/chunk-000/file-000.parquet")
    assert table["action"].to_pylist() == [1.0, 1.0, 1.0]  # a single number is not a list


def test_a_failure_leaves_no_folder(convert, demo, tmp_path, capsys):
    with BagWriter(tmp_path / "still") as writer:
        writer.write("/joint_states", joint_state(START, a=1.0), START)
        writer.write("/commands", get_message("std_msgs/msg/Float64MultiArray")(data=[1.0]), START)
    words = ("--action", "/commands:data")
    folder = convert(demo, tmp_path / "still", *words, status=1)
    assert "episode 1 differs" in capsys.readouterr().err
    assert sorted(each.name for each in tmp_path.iterdir()) == ["demo", "still"]
    assert convert(demo, *words).stat().st_mode & 0o777 == demo.stat().st_mode & 0o777
    convert(demo, *words, status=1)
    assert f"{folder} exists already" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["--action", "/commands"], "name the fields of /commands, such as --action"),
        (["--action", "/command:data"], "/command"),
        (["--action", "/commands:dat"], "has no field 'dat'"),
        (["--action", "/commands:data", "--pose", "hand"], "expected --pose TARGET:SOURCE"),
        (["--action", "/commands:data", "--pose", "a:b"], '"a" passed to lookupTransform'),
        (["--action", "/commands:data", "--camera", "=/x"], "expected --camera NAME=TOPIC"),
        (["--action", "/commands:data", "--camera", "a/b=/x"], "LeRobot allows no / in the name"),
        (["--action", "/joint_states:name"], "/joint_states:name has no numbers"),
        (["--action", "/commands:data", "--fps", "0"], "expected at least 1 row a second"),
        (["--action", "/commands:data", "--joints", ""], "the state is empty"),
    ],
)
def test_mistakes_are_named(convert, demo, capsys, words, text):
    folder = convert(demo, *words, status=1)
    assert text in capsys.readouterr().err
    assert not folder.exists()


def test_a_demo_bag_that_exists_is_kept(demo):
    program = EXAMPLES / "bag_to_lerobot" / "demo_bag.py"
    command = [sys.executable, program, demo]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (1, f"{demo} exists already\n")


def test_a_folder_in_a_missing_folder_is_named(recipe, demo, tmp_path, capsys):
    words = [str(demo), "--action", "/commands:data", "-o", str(tmp_path / "none" / "set")]
    assert recipe.bag_to_lerobot.main(words) == 1
    assert capsys.readouterr().err == f"the folder {tmp_path / 'none'} does not exist\n"


def test_topics_that_do_not_fit_are_named(recipe, tmp_path):
    with BagWriter(tmp_path / "odd") as writer:
        writer.add_topic("/empty", "sensor_msgs/msg/JointState")
        writer.write("/joint_states", joint_state(START, a=1.0), START)
        late = START + 9 * SECOND
        writer.write("/cmd_vel", twist(1.0), late)
        depth = image("16UC1", np.zeros((4, 6), np.uint16))
        writer.write("/depth", stamped(depth, START), START)
    wanted = recipe.aligned.Wanted
    with open_bag(tmp_path / "odd") as bag:
        with pytest.raises(ValueError, match="/empty has no messages"):
            recipe.aligned.align(bag, wanted(10, "/empty", "/cmd_vel", ["linear.x"]))
        with pytest.raises(ValueError, match=r"one begins 9\.000 s after another ends"):
            recipe.aligned.align(bag, wanted(10, "/joint_states", "/cmd_vel", ["linear.x"]))
        with pytest.raises(ValueError, match="no video of 16UC1 images; possible are rgb8"):
            list(recipe.images.images_of(bag, "/depth", np.array([START])))
        with pytest.raises(BagError, match="/none"):
            recipe.aligned.align(bag, wanted(10, "/none", "/cmd_vel", ["linear.x"]))
