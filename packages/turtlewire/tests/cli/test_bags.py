"""`turtlewire bag tf`, `trajectory`, `compare` and `doctor` on bags and files."""

import io
import json
import os
import re
import shutil
import subprocess
import sys
from types import SimpleNamespace

import pytest
from rosbags.typesys import Stores, get_typestore
from tests.bags import SECOND, START, transform, write_bag
from tests.places import ROOT, TURTLEWIRE
from tests.rosbags_messages import write_ros1

from turtlewire import msg
from turtlewire.bag import BagWriter, reindex
from turtlewire.cli.main import main
from turtlewire.trajectory import Trajectory

from ..bag.conftest import GOLDEN
from .test_main import offered


def run(capsys, *words):
    try:
        status = main([str(word) for word in words])
    except SystemExit as end:
        status = end.code
    said = capsys.readouterr()
    return SimpleNamespace(status=status, out=said.out, err=said.err)


@pytest.fixture
def bag(tmp_path):
    return write_bag(tmp_path / "made")


def keys_in(value):
    """All keys of dictionaries in a JSON value, without names of topics and frames."""
    if isinstance(value, dict):
        own = {key for key in value if key.isidentifier()}
        return own.union(*map(keys_in, value.values()))
    return set().union(*map(keys_in, value)) if isinstance(value, list) else set()


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("doctor", ("bag",)),
        ("bag info", ("bag",)),
        ("bag tf", ("bag",)),
        ("trajectory", ("bag", "odom", "camera")),
        ("compare", ("way.tum", "way.tum")),
    ],
)
def test_the_keys_of_json_are_documented(capsys, tmp_path, monkeypatch, command, words):
    monkeypatch.chdir(tmp_path)
    write_bag(tmp_path / "bag")
    (tmp_path / "bag" / "metadata.yaml").unlink()  # a finding of doctor
    (tmp_path / "way.tum").write_text("1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n3 2 1 0 0 0 0 1\n")
    page = (ROOT / "docs" / "reference" / "ros2_json.md").read_text(encoding="utf-8")
    (row,) = re.findall(rf"^\| `turtlewire {command}` \| (.*) \|$", page, re.MULTILINE)
    found = json.loads(run(capsys, *command.split(), *words, "--json").out)
    assert keys_in(found)
    assert keys_in(found) <= set(re.findall(r"`(\w+)`", row))


def test_the_tree_of_a_bag(capsys):
    done = run(capsys, "bag", "tf", GOLDEN / "d_mcap")
    assert done.status == 0
    lines = done.out.splitlines()
    assert lines[0] == "d_mcap: 198 messages of /tf (1 publisher), /tf_static (2 publishers)"
    assert "│  │  ├─ basket                   static" in done.out
    assert any(line.startswith("   ├─ nozzle") and " 6.4 Hz       64 " in line for line in lines)
    for line in (
        "new parent: 'pump' leaves 'nozzle' for 'ladder' at 1795317835.381932279",
        "out of order: the stamps of 'boom_left' step back 3 times, by up to 214.481 ms",
        "gap: 'scarecrow' pauses for 3.328 s from 1795317833.768244304",
    ):
        assert line in lines
    found = json.loads(run(capsys, "bag", "tf", GOLDEN / "d_mcap", "--json").out)
    (change,) = found["new_parents"]
    assert (change["child_frame"], change["before"], change["after"]) == (
        "pump",
        "nozzle",
        "ladder",
    )
    assert found["steps_back"]["boom_left"]["times"] == 3


def test_the_tree_as_json(capsys, bag):
    found = json.loads(run(capsys, "bag", "tf", bag, "--json").out)
    by_name = {frame["frame"]: frame for frame in found["frames"]}
    assert by_name["base_link"]["samples"] == 100
    assert by_name["base_link"]["parent"] == "odom"
    assert by_name["odom"] == {"frame": "odom", "parent": None}
    assert by_name["camera"]["static"]
    assert (found["messages"], found["problems"], found["conflicts"]) == (101, [], [])


def test_the_tree_where_the_output_has_no_such_characters(monkeypatch, tmp_path):
    path = tmp_path / "made"
    with BagWriter(path) as writer:
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        writer.write("/tf", transform(0, "haus", "küche"), START)
    written = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(written, encoding="ascii"))
    assert main(["bag", "tf", str(path)]) == 0
    sys.stdout.flush()
    assert rb"k\xfcche" in written.getvalue()


def test_a_reader_that_has_seen_enough(bag):
    """`turtlewire bag tf BAG | head` ends without a word."""
    command = [TURTLEWIRE, "bag", "tf", bag]
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run(command, stdout=writer, stderr=subprocess.PIPE, text=True, check=False)
    os.close(writer)
    assert (done.returncode, done.stderr) == (141, "")


def test_other_topics(capsys, tmp_path):
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/r1/tf", "tf2_msgs/msg/TFMessage")
        writer.write("/r1/tf", transform(1), 1)
    done = run(capsys, "bag", "tf", tmp_path / "made")
    assert done.status == 2
    assert "Topics of type tf2_msgs/msg/TFMessage in it: /r1/tf." in done.err
    words = ("bag", "tf", tmp_path / "made", "--topic", "/r1/tf")
    assert "base_link" in run(capsys, *words).out
    done = run(capsys, *words, "--topic", "/r2/tf")
    assert (done.status, done.out) == (2, "")
    assert "made has no topic /r2/tf. Topics of type tf2_msgs/msg/TFMessage in it: /r1/tf." in (
        done.err
    )


def test_a_trajectory_is_shown_written_and_drawn(capsys, bag, tmp_path):
    out, picture = tmp_path / "out.kitti", tmp_path / "out.svg"
    done = run(
        capsys, "trajectory", bag, "odom", "camera", "--rate", 10, "-o", out, "--plot", picture
    )
    assert done.status == 0
    assert "  poses     10\n" in done.out
    assert "  rate      10.0 Hz\n" in done.out
    assert f"  written   {out} (kitti)\n" in done.out
    written = Trajectory.load(out)
    assert written.stamps_ns.tolist() == [START + i * SECOND // 10 for i in range(10)]
    assert picture.read_text().startswith("<svg")
    converted = run(capsys, "trajectory", out, "-o", tmp_path / "out.tum", "--json")
    assert json.loads(converted.out)["poses"] == 10
    assert len(Trajectory.load(tmp_path / "out.tum")) == 10


def test_a_topic_and_its_gaps(capsys, tmp_path):
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/odom", "nav_msgs/msg/Odometry")
        for i in (*range(50), *range(100, 150)):
            odometry = msg.get_message("nav_msgs/msg/Odometry")()
            odometry.header.stamp.sec, odometry.header.stamp.nanosec = divmod(
                START + i * 20_000_000, SECOND
            )
            odometry.pose.pose.orientation.w = 1.0
            writer.write("/odom", odometry, START + i)
    done = run(capsys, "trajectory", tmp_path / "made", "/odom")
    assert "gap       1.020 s from 1700000000.980000 s: no poses" in done.out
    found = json.loads(run(capsys, "trajectory", tmp_path / "made", "/odom", "--json").out)
    assert found["gaps"] == [[START + 980_000_000, START + 2 * SECOND]]
    whole = run(capsys, "trajectory", tmp_path / "made", "/odom", "--max-gap", 2)
    assert "no poses" not in whole.out


def test_comparing(capsys, bag, tmp_path):
    reference = tmp_path / "reference.tum"
    run(capsys, "trajectory", bag, "odom", "base_link", "-o", reference)
    estimate = f"{bag}:odom:camera"
    done = run(capsys, "compare", reference, estimate)
    assert done.status == 0
    assert "100 pairs of poses, aligned: none" in done.out
    assert "APE trans_part (m)\n       max\t0.000000\n" in done.out
    assert "RPE trans_part (m) over 1 frame\n       max\t0.000000\n" in done.out
    for kind in ("path", "errors", "error-path", "box", "histogram"):
        picture = tmp_path / f"{kind}.svg"
        assert (
            run(capsys, "compare", reference, estimate, "--plot", picture, "--kind", kind).status
            == 0
        )
        assert picture.read_text().startswith("<svg")
    (found,) = json.loads(
        run(capsys, "compare", reference, estimate, "--align", "yaw", "--json").out
    )
    assert (found["pairs"], found["align"], found["scale"]) == (100, "yaw", 1.0)
    assert found["ape"]["rmse"] < 1e-9
    two = run(capsys, "compare", reference, estimate, f"{bag}:odom:base_link", "--json")
    assert len(json.loads(two.out)) == 2


def test_a_single_pose_has_no_relative_error(capsys, tmp_path):
    (tmp_path / "one.tum").write_text("1 0 0 0 0 0 0 1\n")
    (tmp_path / "two.tum").write_text("1 3 4 0 0 0 0 1\n2 0 0 0 0 0 0 1\n")
    words = ("compare", tmp_path / "two.tum", tmp_path / "one.tum")
    done = run(capsys, *words)
    assert (done.status, done.err) == (0, "")
    assert "APE trans_part (m)\n       max\t5.000000\n" in done.out
    reason = "no two poses are 1 frame apart; the trajectory has 1 pose"
    assert f"RPE trans_part: cannot be computed, {reason}\n" in done.out
    (found,) = json.loads(run(capsys, *words, "--json").out)
    assert (found["ape"]["max"], found["rpe"], found["rpe_missing"]) == (5.0, None, reason)
    ratio = run(capsys, *words, "--relation", "point_distance_error_ratio")
    assert "APE point_distance (m)" in ratio.out


def test_kitti_names_the_file_with_the_times(capsys, bag, tmp_path):
    done = run(capsys, "trajectory", bag, "odom", "camera", "-o", tmp_path / "out.kitti")
    assert f"written   {tmp_path / 'out.kitti'} (kitti)" in done.out
    assert f"written   {tmp_path / 'out_times.txt'} (the times)" in done.out
    assert len((tmp_path / "out_times.txt").read_text().splitlines()) == 100


def test_the_way_across_a_gap_has_no_speed(capsys, tmp_path):
    stamps = [*range(10), *range(100, 110)]
    poses = "".join(f"{stamp} {stamp % 100} 9 0 0 0 0 1\n" for stamp in stamps)
    (tmp_path / "walk.tum").write_text(poses.replace("109 9 ", "109 10 "))
    figures = json.loads(run(capsys, "trajectory", tmp_path / "walk.tum", "--json").out)
    assert len(figures["gaps"]) == 1
    assert (figures["mean_speed"], figures["max_speed"]) == (pytest.approx(19 / 18), 2.0)
    done = run(capsys, "trajectory", tmp_path / "walk.tum", "--max-gap", "0.5")
    assert done.status == 0  # each step is a gap
    assert "speed" not in done.out


def test_kitti_without_times_has_no_rate(capsys, tmp_path):
    poses = "".join(f"1 0 0 {x} 0 1 0 0 0 0 1 0\n" for x in range(3))
    (tmp_path / "walk.kitti").write_text(poses)
    done = run(capsys, "trajectory", tmp_path / "walk.kitti")
    source = f"none; those of KITTI are read from {tmp_path / 'walk_times.txt'}"
    assert done.out.endswith(f"  poses     3\n  path      2.000 m\n  times     {source}\n")
    figures = json.loads(run(capsys, "trajectory", tmp_path / "walk.kitti", "--json").out)
    absent = ("duration", "start_ns", "end_ns", "rate", "mean_speed", "max_speed")
    assert [figures[key] for key in absent] == [None] * 6


def test_the_estimate_that_cannot_be_compared_is_named(capsys, tmp_path):
    (tmp_path / "one.tum").write_text("1 0 0 0 0 0 0 1\n")
    (tmp_path / "two.tum").write_text("2 0 0 0 0 0 0 1\n")
    done = run(capsys, "compare", *(tmp_path / f"{name}.tum" for name in ("one", "one", "two")))
    assert done.status == 2
    assert f"compare: {tmp_path / 'two.tum'}: no stamps of the two trajectories" in done.err


@pytest.mark.parametrize(
    ("text", "what"), [("", "nothing"), ("# t x y z\n\n", "only comments and words")]
)
def test_a_file_without_data_is_no_trajectory(capsys, tmp_path, text, what):
    (tmp_path / "empty.txt").write_text(text)
    done = run(capsys, "trajectory", tmp_path / "empty.txt")
    assert (done.status, done.out) == (2, "")
    assert f"empty.txt is not a trajectory: it contains {what}, but no lines of numbers" in done.err


def test_remarks_about_a_file_are_lines_below_each_other(capsys, tmp_path):
    path = tmp_path / "walk.tum"
    path.write_text("1 0 0 0 0 0 0 2\n1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n")
    remarks = (
        f"note: {path}: 1 of 3 stamps repeat the previous one; the first pose is used\n"
        f"note: {path}: 1 of 3 quaternions are normalised\n"
    )
    done = run(capsys, "trajectory", path)
    assert (done.status, done.err) == (0, remarks)
    assert "  poses     2\n" in done.out
    done = run(capsys, "compare", path, path)
    assert (done.status, done.err) == (0, 2 * remarks)


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ("trajectory BAG odom camra", "Did you mean 'camera'?"),
        ("trajectory BAG", "is a bag: name a topic, or a target and a source frame"),
        ("trajectory BAG a b c", "expected a topic or two frames, got 3 names"),
        ("trajectory BAG odom camera --rate 0", "'0' is not a number above 0"),
        ("trajectory BAG odom camera --plot a.gif", "a.gif does not end in .svg"),
        ("trajectory BAG /chatter", "which has no poses"),
        ("trajectory nothing", "turtlewire trajectory: nothing: No such file or directory\n"),
        ("trajectory BAG odom camera -o no/where.tum", "no/where.tum: No such file or directory"),
        (
            "compare BAG:odom:camera BAG:odom:camera --align se3",
            "Umeyama alignment is not possible: the positions are on a line",
        ),
        ("compare BAG:odom:camera BAG:odom:camera --algn se3", "Did you mean: --align"),
        ("compare BAG:odom:camera", "the following arguments are required: ESTIMATE"),
        ("bag tff BAG", "Did you mean: tf"),
        ("bag tf nothing", "there is no bag at nothing"),
        ("doctor nothing", "there is no bag at nothing"),
        ("doctor BAG --listen 2", "--listen cannot be combined with"),
        ("trajectory BAG base_link camera --rate 10", "bag tf BAG` shows which frames have a rate"),
        ("compare BAG:odom:camera BAG:odom:camera --plane ab", "ab"),
        ("doctor --topic /r1/tf --topic /r2/tf", "--topic and --static-topic may be repeated"),
        ("trajectory BAG /odom --topic /r1/tf", "need two frames"),
        ("trajectory BAG /odom --rate 10", "--rate needs two frames"),
        ("trajectory BAG odom camera --format kitti", "--format needs --output"),
        ("trajectory BAG odom camera --kind speeds", "--kind needs --plot"),
        ("compare BAG:odom:camera BAG:odom:camera --kind box", "--kind needs --plot"),
        ("compare BAG:odom:camera BAG:odom:camera --offset nan", "'nan' is not a number of sec"),
        ("compare BAG:odom:camera BAG:odom:camera --offset 1e300", "'1e300' is not a number of"),
        ("compare BAG:odom:camera BAG:odom:camera --poses-to-align 5", "needs --align"),
    ],
)
def test_mistakes(capsys, bag, words, text):
    done = run(capsys, *(word.replace("BAG", str(bag)) for word in words.split()))
    assert done.status == 2
    assert text.replace("BAG", str(bag)) in done.err
    assert "Traceback" not in done.err
    assert not done.out


def test_commands_in_errors_can_be_typed(capsys, bag, tmp_path):
    path = shutil.copytree(bag, tmp_path / "my bag")
    tf = f"turtlewire bag tf '{path}'`"
    assert tf in run(capsys, "trajectory", path).err
    err = run(capsys, "trajectory", path, "base_link", "camera").err
    assert tf in err
    assert f"turtlewire compare OTHER '{path}:base_link:camera'`" in err


def test_poses_without_a_partner_are_counted(capsys, bag, tmp_path):
    whole, part, one = tmp_path / "whole.tum", tmp_path / "part.tum", tmp_path / "one.tum"
    run(capsys, "trajectory", bag, "odom", "base_link", "-o", whole)
    lines = whole.read_text().splitlines(keepends=True)
    part.write_text("".join(lines[:60]))
    one.write_text(lines[5])
    found = run(capsys, "compare", whole, part).out
    assert "\n60 pairs of poses, aligned: none\nof 100 poses of the reference and 60 of " in found
    assert "\n1 pair of poses, aligned: none\n\n" in run(capsys, "compare", one, one).out
    assert "\n1 pair of poses, aligned: none\nof 100 " in run(capsys, "compare", whole, one).out
    (figures,) = json.loads(run(capsys, "compare", part, whole, "--json").out)
    counts = figures["pairs"], figures["reference_poses"], figures["estimate_poses"]
    assert counts == (60, 60, 100)


def test_two_estimates_have_no_single_error_path(capsys, bag, tmp_path):
    sources = [f"{bag}:odom:camera"] * 2 + [f"{bag}:odom:base_link"]
    done = run(capsys, "compare", *sources, "--plot", tmp_path / "a.svg", "--kind", "errors")
    assert done.status == 2
    assert "'errors' shows one estimate" in done.err


def test_the_doctor_finds_on_a_bag_what_it_finds_live(capsys):
    done = run(capsys, "doctor", GOLDEN / "d_mcap")
    assert done.status == 1
    for text in (
        "PROBLEM: The frames form 2 separate trees, with the roots elsewhere, world.",
        "PROBLEM: The stamps of 'boom_left' jump back, by up to 0.214 s.",
        "PROBLEM: Transforms of 'nozzle' are rejected: 1 nan_value.",
        "note: 'pump' leaves its parent 'nozzle' for 'ladder' at 1795317835.382 s.",
        "note: 'scarecrow' pauses once, for up to 3.328 s.",
        "note: The newest transform of 'weathercock' is 3.1 s old at the end of the bag.",
        "    Its publisher ended before the recording",
        "note: The frame 'drone' leaps by up to 0.5 m between transforms.",
    ):
        assert text in done.out


def test_the_doctor_finds_faults_of_the_bag(capsys, bag):
    assert run(capsys, "doctor", bag).out == "No problems found.\n"
    (bag / "metadata.yaml").unlink()
    done = run(capsys, "doctor", bag)
    assert (done.status, done.err) == (0, "")
    assert "note: The bag has no metadata.yaml." in done.out
    (file,) = bag.glob("*.mcap")
    file.write_bytes(file.read_bytes()[:5000])
    done = run(capsys, "doctor", bag, "--json")
    assert done.status == 1
    assert "made_0.mcap" in json.loads(done.out)["findings"][0]["text"]


@pytest.mark.parametrize("topic", ["/tf", "/a"])
def test_a_missing_file_is_named_with_its_remedy(capsys, tmp_path, monkeypatch, topic):
    monkeypatch.chdir(tmp_path)
    message = transform(0) if topic == "/tf" else msg.get_message("std_msgs/msg/String")()
    with BagWriter("split", max_file_bytes=1000, chunk_bytes=100) as writer:
        for number in range(30):
            writer.write(topic, message, START + number)
    os.remove("split/split_1.mcap")
    text = "split/split_1.mcap: No such file or directory; the other files were read"
    assert f"\ndamaged: {text}\n" in run(capsys, "bag", "info", "split").out
    remedy = "Put the file back, or let `ros2 bag reindex split` forget it."
    assert f"PROBLEM: {text}\n    {remedy}\n" in run(capsys, "doctor", "split").out


def test_reindex_is_not_advised_for_a_file_of_ros1(capsys, tmp_path):
    path = tmp_path / "one.bag"
    write_ros1(path, get_typestore(Stores.ROS1_NOETIC), ["std_msgs/msg/Int8"])
    path.write_bytes(path.read_bytes()[:-100])
    done = run(capsys, "doctor", path)
    assert done.status == 1
    assert "The intact part was read. Copy the file again.\n" in done.out


def test_a_file_of_a_split_bag_is_a_part(capsys):
    folder = GOLDEN / "real" / "g_mcap_split"
    done = run(capsys, "doctor", folder / "g_mcap_split_2.mcap")
    assert done.status == 0
    assert f"note: g_mcap_split_2.mcap is one of several files of the bag {folder}." in done.out
    assert f"turtlewire doctor {folder}\n" in done.out
    assert "Copy the file again" not in done.out
    done = run(capsys, "bag", "tf", folder / "g_mcap_split_2.mcap")
    assert f"open {folder} for all of it" in done.out


def test_the_doctor_on_bags_without_or_with_odd_transforms(capsys, tmp_path):
    with BagWriter(tmp_path / "none") as writer:
        writer.add_topic("/chatter", "std_msgs/msg/String")
    assert "note: The bag has no transforms." in run(capsys, "doctor", tmp_path / "none").out
    with BagWriter(tmp_path / "odd") as writer:
        for topic in ("/tf", "/tf_static"):
            writer.add_topic(topic, "tf2_msgs/msg/TFMessage")
        for i in range(20):
            writer.write("/tf", transform(i, ("odom", "map")[i % 2]), i)
        writer.write("/tf_static", transform(0, "base_link", "wheel"), 1)
        writer.write("/tf", transform(0, "base_link", "wheel"), 30)
        writer.write("/tf", b"nonsense", 31)
    done = run(capsys, "doctor", tmp_path / "odd")
    assert "'base_link' goes back and forth between the parents 'map' and 'odom'" in done.out
    assert "'wheel' is sent by '/tf' and '/tf_static'" in done.out
    assert "Not a TFMessage: 1 message of /tf: " in done.out


def test_a_frame_that_is_static_and_moves_and_publishers_nobody_noted(capsys, tmp_path):
    with BagWriter(tmp_path / "both") as writer:
        for topic in ("/tf", "/tf_static"):
            writer.add_topic(topic, "tf2_msgs/msg/TFMessage")
        writer.write("/tf_static", transform(0, "base_link", "wheel"), 1)
        writer.write("/tf", transform(0, "base_link", "wheel"), 2)
    out = run(capsys, "bag", "tf", tmp_path / "both").out
    assert out.startswith("both: 2 messages of /tf (publishers unknown), /tf_static (publ")
    assert "wheel   static and one stamp" in out
    assert "0.0 Hz" not in out


def test_frames_of_a_bag_with_and_without_a_slash(capsys, tmp_path):
    bag, renamed = tmp_path / "bridged", tmp_path / "renamed"
    with BagWriter(bag) as writer:
        for topic in ("/tf", "/tf_static"):
            writer.add_topic(topic, "tf2_msgs/msg/TFMessage")
        for i in range(3):
            writer.write("/tf", transform(i, "odom", "base_link"), START + i)
        writer.write("/tf_static", transform(0, "/base_link", "/laser"), START)
        writer.write("/tf", b"\0\1\0\0\0\0\0\0\0/", START + 3)
    (text, advice), (other, _) = (
        (finding["text"], finding["remedy"])
        for finding in json.loads(run(capsys, "doctor", bag, "--json").out)["findings"]
        if "slash" in finding["text"]
    )
    assert text == "The frame 'base_link' is published with and without a leading slash."
    assert other == "The frame 'laser' is published with a leading slash."
    words = advice.split("`")[1].replace("BAG", str(bag)).replace("NEW", str(renamed)).split()
    assert run(capsys, *words[1:]).status == 0
    found = run(capsys, "doctor", renamed).out
    assert "'laser' is published with a leading slash" in found
    assert "'base_link' is published with" not in found


@pytest.mark.parametrize("topic", ["/tf", "/tf_static"])
def test_slashes_are_found_in_a_bag_with_only_one_topic(capsys, tmp_path, topic):
    with BagWriter(tmp_path / "ros1") as writer:
        for i in range(2):
            writer.write(topic, transform(i, "/odom", "/base_link"), START + i)
    found = run(capsys, "doctor", tmp_path / "ros1").out
    assert "The frames 'base_link' and 'odom' are published with a leading slash" in found
    assert "--rename-frame /base_link:=base_link --rename-frame /odom:=odom`." in found


def test_transforms_on_other_topics(capsys, tmp_path):
    bag = tmp_path / "r1"
    with BagWriter(bag) as writer:
        for topic in ("/r1/tf", "/r1/tf_static"):
            writer.add_topic(topic, "tf2_msgs/msg/TFMessage")
        for i in range(20):
            writer.write("/r1/tf", transform(i), START + i * 10_000_000)
        writer.write("/r1/tf_static", transform(0, "base_link", "wheel"), START)
    done = run(capsys, "doctor", bag)
    options = ("--topic", "/r1/tf", "--static-topic", "/r1/tf_static")
    assert "The bag has transforms on /r1/tf, /r1/tf_static, which are not examined." in done.out
    assert f"turtlewire doctor {bag} {' '.join(options)}\n" in done.out
    assert run(capsys, "doctor", bag, *options).out == "No problems found.\n"
    wrong = run(capsys, "doctor", bag, "--topic", "/r2/tf")
    assert (wrong.status, "none of the topics /r2/tf, /tf_static" in wrong.out) == (1, True)
    done = run(capsys, "trajectory", bag, "odom", "wheel", *options)
    assert (done.status, "  poses     20\n" in done.out) == (0, True)
    source = f"{bag}:odom:wheel"
    assert run(capsys, "compare", source, source, *options).status == 0
    done = run(capsys, "compare", source, source)
    assert (done.status, "in it: /r1/tf, /r1/tf_static." in done.err) == (2, True)


def test_the_doctor_names_a_loop_in_a_bag(capsys, tmp_path):
    with BagWriter(tmp_path / "loop") as writer:
        writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        for i in range(20):
            writer.write("/tf", transform(i, "a", "b"), START + i)
            writer.write("/tf", transform(i, "b", "a"), START + i)
    done = run(capsys, "doctor", tmp_path / "loop")
    assert done.status == 1
    assert "PROBLEM: The frames form a loop, from child to parent: a -> b -> a." in done.out


def test_damage_is_named_where_it_left_no_transforms(capsys, tmp_path):
    """A bag of one chunk, cut before its first transform: not "no transforms" alone, but why."""
    shutil.copytree(GOLDEN / "d_mcap", tmp_path / "cut")
    with open(tmp_path / "cut" / "d_mcap_0.mcap", "r+b") as file:
        file.truncate(700)
    damage = "d_mcap_0.mcap: the record at byte 567 is cut off or damaged"
    (tmp_path / "cut" / "metadata.yaml").unlink()
    done = run(capsys, "bag", "tf", tmp_path / "cut")
    assert done.status == 2
    assert "none of the topics /tf, /tf_static. It has no TF. Damaged: " in done.err
    assert damage in done.err
    done = run(capsys, "doctor", tmp_path / "cut")
    assert done.status == 1
    assert damage in done.out
    reindex(tmp_path / "cut")  # makes the file whole
    assert run(capsys, "doctor", tmp_path / "cut").status == 0


def test_a_file_has_gaps_too(capsys, tmp_path):
    (tmp_path / "a.tum").write_text("".join(f"{t} 0 0 0 0 0 0 1\n" for t in (1, 2, 3, 4, 50)))
    assert "gap       46.000 s from 4.000000 s" in run(capsys, "trajectory", tmp_path / "a.tum").out
    done = run(capsys, "trajectory", tmp_path / "a.tum", "--max-gap", "50")
    assert "gap " not in done.out


def test_tab(tmp_path, bag, monkeypatch):
    monkeypatch.chdir(tmp_path)
    answers = tmp_path / "answers"
    assert {"bag", "trajectory", "compare", "doctor", "frames"} <= set(
        offered("turtlewire ", answers)
    )
    assert offered("turtlewire bag ", answers) == ["info", "cut", "filter", "merge", "split", "tf"]
    assert "made/" in offered("turtlewire bag tf m", answers)
    assert offered("turtlewire trajectory made c", answers) == ["camera"]
    assert offered("turtlewire trajectory made odom ba", answers) == ["base_link"]
    assert "se3" in offered("turtlewire compare a b --align ", answers)
    shutil.rmtree(bag)
    assert offered("turtlewire trajectory made c", answers) == []


def test_a_path_with_a_colon(capsys, tmp_path, bag):
    run(capsys, "trajectory", bag, "odom", "camera", "-o", tmp_path / "a.tum")
    odd = tmp_path / "a:b.tum"
    Trajectory.load(tmp_path / "a.tum").save(odd)
    assert run(capsys, "compare", odd, odd).status == 0
