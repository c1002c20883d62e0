"""examples/rerun_log logs the transforms and messages of bags and of running nodes."""

import asyncio
import importlib
import io
import signal
import struct
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image as Picture
from tests.bags import SECOND, START, stamped
from tests.places import EXAMPLES

import turtlewire
from turtlewire.bag import BagWriter
from turtlewire.msg import get_message

rerun = pytest.importorskip("rerun", reason="the recipe needs Python 3.11")
from rerun.chunk import RrdReader  # noqa: E402


@pytest.fixture
def recipe(monkeypatch):
    """The modules of the recipe, and the demo bag of another one."""
    monkeypatch.syspath_prepend(str(EXAMPLES / "rerun_log"))
    monkeypatch.syspath_prepend(str(EXAMPLES / "bag_to_lerobot"))
    names = ("demo_bag", "entities", "rerun_log")
    return SimpleNamespace(**{name: importlib.import_module(name) for name in names})


def read(path):
    """Rows of each entity of a file, as dictionaries, in order of time; static rows are first."""
    rows = defaultdict(list)
    for chunk in RrdReader(str(path)).stream():
        for row in chunk.to_record_batch().to_pylist():
            found = {name.rpartition(":")[2]: value for name, value in row.items()}
            rows[chunk.entity_path].append(found)
    for found in rows.values():
        found.sort(key=lambda row: str(row.get("stamp", "")))
    return rows


def values(rows, field):
    return [row[field][0] for row in rows if row.get(field)]


def stamps(rows):
    return [row["stamp"] for row in rows if row.get("stamp") is not None]


def transform(parent, child, x, stamp=START):
    made = get_message("geometry_msgs/msg/TransformStamped")(child_frame_id=child)
    made.transform.translation.x, made.transform.rotation.w = x, 1.0
    stamped(made, stamp, parent)
    return get_message("tf2_msgs/msg/TFMessage")(transforms=[made])


def test_a_bag_becomes_columns(recipe, tmp_path):
    bag, file = tmp_path / "demo", tmp_path / "demo.rrd"
    recipe.demo_bag.write_demo_bag(str(bag), seconds=1.0, seed=3)
    assert recipe.rerun_log.main([str(bag), "-o", str(file)]) == 0
    rows = read(file)
    truth = list(recipe.demo_bag.angles_over_time(1.0, 3))[::10]
    upper_arm = [row for row in rows["/tf/upper_arm"] if row.get("translation")]
    assert len(upper_arm) == len(truth) == 100
    assert set(values(upper_arm, "parent_frame")) == {"base_link"}
    assert set(values(upper_arm, "child_frame")) == {"upper_arm"}
    half = np.array([angles[0] for _, _, angles in truth]) / 2
    turns = np.array(values(upper_arm, "quaternion"))
    np.testing.assert_allclose(
        turns[:, 2:], np.column_stack([np.sin(half), np.cos(half)]), atol=1e-6
    )
    np.testing.assert_array_equal(
        np.array(values(rows["/tf/forearm"], "translation"))[:, 0], np.float32(0.3)
    )
    assert values(rows["/tf/camera"], "translation") == [[0.0, 0.0, 1.0]]
    assert stamps(rows["/tf/camera"]) == []  # it is static
    elbow = rows["/joint_states/elbow"]
    np.testing.assert_allclose(values(elbow, "scalars"), [angles[1] for _, _, angles in truth])
    first, last = (stamp.value for stamp in (stamps(elbow)[0], stamps(elbow)[-1]))
    assert (first, last) == (START, START + 990_000_000)
    images = rows["/camera/image_raw"]
    assert values(images, "frame") == ["camera image"]
    assert len(values(images, "buffer")) == 30
    pixels = np.array(values(images, "buffer")[-1], np.uint8).reshape(120, 160, 3)
    assert np.array_equal(
        pixels, recipe.demo_bag.picture(list(recipe.demo_bag.angles_over_time(1.0, 3))[967][2])
    )
    camera = rows["/camera/camera_info"]
    assert set(values(camera, "parent_frame")) == {"camera"}
    assert set(values(camera, "child_frame")) == {"camera image"}
    assert values(camera, "image_from_camera")[0] == [100, 0, 0, 0, 100, 0, 80, 60, 1]


def test_live_transforms_and_topics_are_logged(recipe, tmp_path):
    class UntilAll(recipe.entities.Entities):
        missing = 7

        def log_message(self, topic, message):
            super().log_message(topic, message)
            self.missing -= 1
            if not self.missing:
                signal.raise_signal(signal.SIGINT)

    def publish():
        fixed.publish(transform("/base", "/camera", 3.0))
        for publisher in (moving, states, fixed):
            assert publisher.wait_for_subscribers(timeout_ns=60 * SECOND)
        for k in range(3):
            moving.publish(transform("odom", "base", float(k), START + k))
            state = get_message("sensor_msgs/msg/JointState")(name=["a"], position=[0.5 * k])
            states.publish(stamped(state, START + k))

    file = tmp_path / "live.rrd"
    with turtlewire.connect("robot") as net, ThreadPoolExecutor(1) as thread:
        moving = net.publisher("/tf", "tf2_msgs/msg/TFMessage")
        fixed = net.publisher("/tf_static", "tf2_msgs/msg/TFMessage", qos=recipe.rerun_log.LATCHED)
        states = net.publisher("/joint_states", "sensor_msgs/msg/JointState")
        published = thread.submit(publish)
        rerun.init("live")
        rerun.save(file)
        asyncio.run(recipe.rerun_log.log_live(UntilAll(), ["/joint_states"], 120))
        rerun.disconnect()
        published.result()
    rows = read(file)
    base = [row for row in rows["/tf/base"] if row.get("translation")]
    assert [row["translation"][0] for row in base] == [[0, 0, 0], [1, 0, 0], [2, 0, 0]]
    assert [stamp.value - START for stamp in stamps(base)] == [0, 1, 2]
    assert values(rows["/tf/base"], "frame") == ["base"]  # it is logged once
    (camera,) = (row for row in rows["/tf/camera"] if row.get("translation"))
    assert (camera["parent_frame"], camera["child_frame"]) == (["base"], ["camera"])
    assert camera.get("stamp") is None
    assert values(rows["/joint_states/a"], "scalars") == [0.0, 0.5, 1.0]


def test_sensors_are_put_into_their_frames(recipe, tmp_path):
    bag, file = tmp_path / "sensors", tmp_path / "sensors.rrd"
    picture = io.BytesIO()
    Picture.new("RGB", (6, 4), (200, 40, 90)).save(picture, "png")
    compressed = get_message("sensor_msgs/msg/CompressedImage")(
        format="png", data=picture.getvalue()
    )
    field = get_message("sensor_msgs/msg/PointField")
    cloud = get_message("sensor_msgs/msg/PointCloud2")(height=1, width=2, point_step=16)
    cloud.fields = [field(name=n, offset=4 * k, datatype=7, count=1) for k, n in enumerate("ixyz")]
    cloud.data = struct.pack("<8f", 9, 1, 2, 3, 9, 4, 5, 6)
    flat = get_message("sensor_msgs/msg/PointCloud2")(height=1, width=1, point_step=4)
    image = get_message("sensor_msgs/msg/Image")
    padded = image(height=2, width=1, encoding="bgr8", step=4, data=bytes([1, 2, 3, 0, 4, 5, 6, 0]))
    depth = image(height=1, width=1, encoding="16UC1", step=2, data=bytes(2))
    with BagWriter(bag) as writer:
        for topic, message in (
            ("/png", compressed),
            ("/points", cloud),
            ("/flat", flat),
            ("/image", padded),
            ("/depth", depth),
        ):
            writer.write(topic, stamped(message, START, "sensor"), START)
        writer.write("/text", get_message("std_msgs/msg/String")(data="x"), START)
    assert recipe.rerun_log.main([str(bag), "-o", str(file)]) == 0
    rows = read(file)
    assert values(rows["/points"], "positions") == [[1, 2, 3]]
    (positions,) = (row["positions"] for row in rows["/points"] if row.get("positions"))
    assert positions == [[1, 2, 3], [4, 5, 6]]
    assert values(rows["/points"], "frame") == ["sensor"]
    assert values(rows["/png"], "frame") == ["sensor image"]
    assert bytes(values(rows["/png"], "blob")[0]) == picture.getvalue()
    assert values(rows["/png"], "media_type") == ["image/png"]
    assert bytes(values(rows["/image"], "buffer")[0]) == bytes([1, 2, 3, 4, 5, 6])
    assert {"/flat", "/depth", "/text"}.isdisjoint(rows)


def test_frames_with_the_slash_of_ros_1_are_those_of_tf2(recipe, tmp_path):
    bag, file = tmp_path / "ros1", tmp_path / "ros1.rrd"
    image = get_message("sensor_msgs/msg/Image")(
        height=1, width=1, encoding="mono8", step=1, data=b"1"
    )
    info = get_message("sensor_msgs/msg/CameraInfo")(height=1, width=1)
    cloud = get_message("sensor_msgs/msg/PointCloud2")(height=1, width=1, point_step=12)
    field = get_message("sensor_msgs/msg/PointField")
    cloud.fields = [field(name=n, offset=4 * k, datatype=7, count=1) for k, n in enumerate("xyz")]
    cloud.data = bytes(12)
    with BagWriter(bag) as writer:
        writer.write("/tf", transform("/base", "/camera", 1.0), START)
        for topic, message in (("/image", image), ("/info", info), ("/points", cloud)):
            writer.write(topic, stamped(message, START, "/camera"), START)
    assert recipe.rerun_log.main([str(bag), "-o", str(file)]) == 0
    rows = read(file)
    assert values(rows["/tf/camera"], "child_frame") == ["camera"]
    assert values(rows["/image"], "frame") == ["camera image"]
    assert values(rows["/info"], "parent_frame") == ["camera"]
    assert values(rows["/info"], "child_frame") == ["camera image"]
    assert values(rows["/points"], "frame") == ["camera"]


def test_a_wrong_bag_is_named_and_keeps_the_file(recipe, tmp_path, capsys):
    file = tmp_path / "a.rrd"
    file.write_text("an earlier recording")
    assert recipe.rerun_log.main([str(tmp_path / "none"), "-o", str(file)]) == 1
    assert "there is no bag at" in capsys.readouterr().err
    assert file.read_text() == "an earlier recording"


def test_a_bag_without_a_known_topic_is_named(recipe, tmp_path, capsys):
    with BagWriter(tmp_path / "texts") as writer:
        writer.write("/text", get_message("std_msgs/msg/String")(data="x"), START)
    words = [str(tmp_path / "texts"), "-o", str(tmp_path / "a.rrd")]
    assert recipe.rerun_log.main(words) == 1
    assert "the bag has std_msgs/msg/String; known are tf2_msgs" in capsys.readouterr().err


def test_a_file_in_a_missing_folder_is_named(recipe, tmp_path, capsys):
    assert recipe.rerun_log.main(["-o", str(tmp_path / "none" / "a.rrd")]) == 1
    assert "none/a.rrd" in capsys.readouterr().err


def test_options_for_running_nodes_are_rejected_with_a_bag(recipe, capsys):
    for words in (["--topic", "/points"], ["--seconds", "0"]):
        with pytest.raises(SystemExit):
            recipe.rerun_log.main(["bag", *words])
        assert "--topic and --seconds are for running nodes" in capsys.readouterr().err


def test_a_running_topic_of_another_type_ends_the_program(recipe, tmp_path, capsys):
    def publish():
        assert texts.wait_for_subscribers(timeout_ns=60 * SECOND)
        texts.publish(data="x")

    words = ["-o", str(tmp_path / "a.rrd"), "--topic", "/text", "--seconds", "120"]
    with turtlewire.connect("robot") as net, ThreadPoolExecutor(1) as thread:
        texts = net.publisher("/text", "std_msgs/msg/String")
        published = thread.submit(publish)
        assert recipe.rerun_log.main(words) == 1
        published.result()
    assert "/text has the type std_msgs/msg/String; known are" in capsys.readouterr().err


def test_logging_ends_after_the_given_time(recipe, tmp_path):
    file = tmp_path / "silent.rrd"
    assert recipe.rerun_log.main(["-o", str(file), "--seconds", "0.1"]) == 0
    assert set(read(file)) <= {"/__properties"}
