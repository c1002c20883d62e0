"""Bags that a real rosbag2 recorded give the messages, metadata and lookups that it gives."""

import gzip
import json
import shutil
import zlib
from pathlib import Path

import pytest

from turtlewire import Buffer
from turtlewire.bag import open_bag
from turtlewire.errors import TransformException

from .conftest import ANSWERED, GOLDEN

#: Of the 500 answers, the errors in which tf2 0.36.20 reports the other leg of a V-shaped path than
#: the core that gave the answers.
OTHER_LEG = {"d_mcap": 11, "d_split_file_zstd": 5, "d_sqlite3_message_zstd": 15}
REAL = sorted(path.name for path in (GOLDEN / "real").iterdir() if path.is_dir())


@pytest.mark.parametrize("name", ANSWERED)
def test_messages(name):
    with gzip.open(GOLDEN / "messages.json.gz", "rt") as file:
        expected = json.load(file)[name]
    with open_bag(GOLDEN / name) as bag:
        found = [[m.topic, m.log_time_ns, len(m.data), zlib.crc32(m.data)] for m in bag]
        assert bag.problems == []
        assert len(bag) == len(expected)
    assert found == expected


@pytest.mark.parametrize("name", ANSWERED)
def test_metadata(name):
    expected = json.loads((GOLDEN / "reads.json").read_text())[name]["metadata"]
    with open_bag(GOLDEN / name) as bag:
        found = bag.metadata
    for key in ("version", "message_count", "compression_format", "custom_data", "ros_distro"):
        assert getattr(found, key) == expected[key], key
    assert found.compression_mode == expected["compression_mode"].upper()
    assert found.storage == expected["storage_identifier"]
    assert found.paths == expected["relative_file_paths"]
    assert (found.start_ns, found.duration_ns) == (expected["starting_time"], expected["duration"])
    assert [file.path for file in found.files] == [file[0] for file in expected["files"]]
    topics = [
        [t.name, t.type, t.serialization_format, t.type_hash, len(t.qos), t.message_count]
        for t in found.topics
    ]
    assert topics == expected["topics"]


@pytest.mark.parametrize("name", ANSWERED)
def test_every_message_can_be_decoded(name):
    with open_bag(GOLDEN / name) as bag:
        types = {type(message.decode())._TYPE_NAME for message in bag}
        assert types == {topic.type for topic in bag.topics.values() if topic.message_count}


@pytest.mark.parametrize("name", ANSWERED)
def test_lookups(name):
    buffer = Buffer.from_bag(GOLDEN / name)
    report = buffer.bag_report
    assert report.problems == []
    wrong, other_leg = [], 0
    with gzip.open(GOLDEN / f"{name}.answers.jsonl.gz", "rt") as file:
        questions = [json.loads(line) for line in file]
    for question in questions:
        answer = ask(buffer, question)
        if is_of_other_leg(question, answer):
            other_leg += 1
        elif not same(question, answer):
            wrong.append((question, answer))
    assert len(questions) == 500
    assert wrong == []
    assert other_leg == OTHER_LEG.get(name, 0)


def is_of_other_leg(question, answer):
    """Return True for the same exception with another link's stamps."""
    if not question.get("error") == answer.get("error") == "ExtrapolationException":
        return False
    texts = [each["text"].partition(", when looking up transform") for each in (question, answer)]
    return texts[0][0] != texts[1][0] and texts[0][1:] == texts[1][1:]


def ask(buffer, q):
    try:
        if "fixed" in q:
            found = buffer.lookup_transform(
                q["target"],
                q["source"],
                q["ns"] or None,
                fixed_frame=q["fixed"],
                target_stamp_ns=q["target_ns"] or None,
            )
        else:
            found = buffer.lookup_transform(q["target"], q["source"], q["ns"] or None)
    except TransformException as error:
        return {"error": type(error).__name__, "text": str(error)}
    return {
        "stamp": found.stamp_ns or 0,  # static transforms are always true
        "frame": found.target_frame,
        "child": found.source_frame,
        "pose": [*found.translation, *found.rotation],
    }


def same(question, answer):
    if "error" in question or "error" in answer:
        return all(question.get(key) == answer.get(key) for key in ("error", "text"))
    keys = ("stamp", "frame", "child")
    expected = [*question["t"], *question["q"]]
    return all(question[key] == answer[key] for key in keys) and answer["pose"] == pytest.approx(
        expected, rel=1e-12, abs=1e-12
    )


@pytest.mark.parametrize("name", REAL)
def test_every_way_in_which_rosbag2_writes_a_bag(name):
    with open_bag(GOLDEN / "real" / name) as bag:
        times = [message.log_time_ns for message in bag]
        assert len(times) == len(bag) > 200
        assert times == sorted(times)
        assert (times[0], times[-1]) == (bag.start_ns, bag.end_ns)
    buffer = Buffer.from_bag(GOLDEN / "real" / name)
    report = buffer.bag_report
    assert len(buffer.frames()) == 5
    assert report.problems == []
    assert report.jumps == []


@pytest.mark.parametrize("name", [*ANSWERED, *(f"real/{name}" for name in REAL)])
def test_without_metadata_the_files_tell_the_same(name, tmp_path):
    copy = tmp_path / Path(name).name
    shutil.copytree(GOLDEN / name, copy)
    with open_bag(copy) as bag:
        told = bag.metadata
        expected = [(m.topic, m.log_time_ns, m.data) for m in bag]
    (copy / "metadata.yaml").unlink()
    with open_bag(copy) as bag:
        found = bag.metadata
        assert [(m.topic, m.log_time_ns, m.data) for m in bag] == expected
    for key in ("storage", "paths", "start_ns", "duration_ns", "message_count", "ros_distro"):
        assert getattr(found, key) == getattr(told, key), key
    counts = [{t.name: t.message_count for t in m.topics if t.message_count} for m in (found, told)]
    assert counts[0] == counts[1]
