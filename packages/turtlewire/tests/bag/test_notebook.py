from __future__ import annotations

import re
import shutil
from xml.etree import ElementTree as ET

import pytest
from tests.bags import SECOND, START, write_bag

from turtlewire import msg
from turtlewire.bag import BagWriter, open_bag
from turtlewire.bag.metadata import BagMetadata, TopicInfo


def parsed(bag):
    return ET.fromstring(f"<div>{bag._repr_html_()}</div>")


def rows(bag):
    return [[cell.text for cell in row] for row in parsed(bag).iterfind(".//tbody/tr")]


def paragraphs(bag):
    return [each.text for each in parsed(bag).iter("p")]


def caption(bag):
    return "".join(parsed(bag).find(".//caption").itertext())


@pytest.fixture
def described(tmp_path):
    """Return a bag with the given metadata."""
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/chatter", "std_msgs/msg/String")
    with open_bag(tmp_path / "made") as bag:

        def describe(topics):
            bag.metadata = BagMetadata("mcap", topics=topics, message_count=7)
            return bag

        yield describe


def test_a_bag_shows_topics_types_counts_and_times(tmp_path, monkeypatch):
    monkeypatch.setattr("turtlewire.bag.notebook.date_text", lambda time: f"@{time - START}")
    with open_bag(write_bag(tmp_path / "my_bag")) as bag:
        assert caption(bag) == "my_bag: 111 messages of 3 topics"
        assert rows(bag) == [
            ["/chatter", "std_msgs/msg/String", "10"],
            ["/tf", "tf2_msgs/msg/TFMessage", "100"],
            ["/tf_static", "tf2_msgs/msg/TFMessage", "1"],
        ]
        assert paragraphs(bag) == ["0.991 s, from @0 to @991000001; mcap, 1 file"]


def test_the_dates_are_those_of_bag_commands(tmp_path):
    with open_bag(write_bag(tmp_path / "my_bag")) as bag:
        date = r"20\d\d-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{9}[+-]\d\d:\d\d"
        assert re.search(f"from {date} to {date};", paragraphs(bag)[0])


def test_the_files_of_a_bag_are_not_read(tmp_path):
    with open_bag(write_bag(tmp_path / "my_bag")) as bag:
        shutil.rmtree(tmp_path / "my_bag")
        assert len(rows(bag)) == 3
        assert bag._files == {}


def test_an_empty_bag_has_no_times(tmp_path):
    with BagWriter(tmp_path / "empty") as writer:
        writer.add_topic("/chatter", "std_msgs/msg/String")
    with open_bag(tmp_path / "empty") as bag:
        assert caption(bag) == "empty: 0 messages of 1 topic"
        assert paragraphs(bag) == ["mcap, 1 file"]


def test_names_cannot_contain_html_or_direction_marks(described):
    bag = described([TopicInfo("/<script>alert(1)</script>&\u202e", '"><img src=x onerror=f()>')])
    html = bag._repr_html_()
    assert "<script" not in html
    assert "<img" not in html
    assert rows(bag) == [["/<script>alert(1)</script>&\\u202e", '"><img src=x onerror=f()>', "0"]]


def test_the_name_and_the_problems_of_a_bag_are_escaped(tmp_path):
    path = write_bag(tmp_path / "<i>bag")
    with open_bag(path) as bag:
        bag.complain("<b>damaged")
        assert caption(bag).startswith("<i>bag: ")
        assert paragraphs(bag)[1:] == ["Problem: <b>damaged"]


def test_ten_problems_are_listed_and_more_are_counted(tmp_path):
    with open_bag(write_bag(tmp_path / "my_bag")) as bag:
        bag.problems += [f"problem {number}" for number in range(10)]
        assert len(paragraphs(bag)) == 11
        bag.complain("another one")
        assert paragraphs(bag)[-1] == "bag.problems lists all 11 problems"
        assert len(paragraphs(bag)) == 12


@pytest.mark.parametrize("count", [500, 501, 10_000])
def test_the_first_500_topics_are_shown(described, count):
    bag = described(
        [TopicInfo(f"/topic{i:05}{'x' * 1000}", "std_msgs/msg/Empty") for i in range(count)]
    )
    assert len(rows(bag)) == 500
    cut = ", the first 500 of them shown" if count > 500 else ""
    assert caption(bag) == f"made: 7 messages of {count:,} topics{cut}"
    assert rows(bag)[499][0] == f"/topic00499{'x' * 108}…"
    assert len(bag._repr_html_()) < 300_000


def test_damage_is_shown(tmp_path):
    path = write_bag(tmp_path / "my_bag")
    (file,) = path.glob("*.mcap")
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    with open_bag(file) as bag:
        assert bag.problems
        assert paragraphs(bag)[1].startswith("Problem: ")


def test_a_bag_of_a_damaged_clock_is_shown(tmp_path):
    with BagWriter(tmp_path / "clock") as writer:
        text = msg.get_message("std_msgs/msg/String")(data="late")
        writer.write("/chatter", text, 2**63 - 1)
        writer.write("/chatter", text, SECOND)
    with open_bag(tmp_path / "clock") as bag:
        assert paragraphs(bag)[0].endswith("; mcap, 1 file")
