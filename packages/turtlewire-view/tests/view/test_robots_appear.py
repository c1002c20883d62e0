"""A robot is shown as soon as a node describes it; "Add" is for more."""

from __future__ import annotations

import pytest

from turtlewire import msg
from turtlewire.wire.qos import Durability, QoS

from .test_robot_model import URDF

DESCRIPTION = {"name": "/robot_description", "type_name": "std_msgs/msg/String", "publishers": 1}
ROBOT = {**DESCRIPTION, "kind": "robot_model"}
SCAN = {"name": "/scan", "type_name": "sensor_msgs/msg/LaserScan", "publishers": 1}
SCAN["kind"] = "laser_scan"


def shown(page) -> list[str]:
    return page.locator("#display-list .title b").all_inner_texts()


def wait_for_topics(page, count) -> None:
    """Until the page knows that many topics that can be drawn."""
    page.wait_for_function(
        "(count) => document.querySelectorAll('#topic option').length === count + 1", arg=count
    )


def added(fake, **fields) -> list[dict]:
    return [
        command
        for command in fake.commands
        if command["type"] == "add" and fields.items() <= command.items()
    ]


def test_a_described_robot_is_shown_without_a_request(fake, open_view):
    page = open_view(fake.url)
    fake.tell({"type": "topics", "topics": [SCAN]})
    wait_for_topics(page, 1)
    assert shown(page) == []
    fake.tell({"type": "topics", "topics": [ROBOT, SCAN]})
    fake.wait_for(lambda c: c["type"] == "add" and c["topic"] == "/robot_description")
    assert shown(page) == ["/robot_description"]


def test_each_robot_is_shown_once_and_one_that_was_removed_stays_away(fake, open_view):
    page = open_view(fake.url)
    other = {**ROBOT, "name": "/second/robot_description"}
    fake.tell({"type": "topics", "topics": [ROBOT]})
    # The page sends a display when its module is loaded; one that is removed before is never sent.
    fake.wait_for(lambda c: c["type"] == "add" and c["topic"] == ROBOT["name"])
    page.click("[aria-label='Remove /robot_description']")
    fake.tell({"type": "topics", "topics": [ROBOT, other]})
    fake.wait_for(lambda c: c["type"] == "add" and c["topic"] == other["name"])
    fake.tell({"type": "topics", "topics": [ROBOT, other, SCAN]})
    wait_for_topics(page, 3)
    assert shown(page) == [other["name"]]
    assert len(added(fake, topic="/robot_description")) == 1
    assert len(added(fake, topic=other["name"])) == 1


def test_a_topic_without_a_publisher_describes_no_robot(fake, open_view):
    page = open_view(fake.url)
    fake.tell({"type": "topics", "topics": [{**ROBOT, "publishers": 0}]})
    wait_for_topics(page, 1)
    assert shown(page) == []
    fake.tell({"type": "topics", "topics": [ROBOT]})
    fake.wait_for(lambda c: c["type"] == "add" and c["topic"] == "/robot_description")


def test_a_robot_that_the_user_has_added_is_not_added_again(fake, open_view):
    page = open_view(fake.url)
    fake.tell({"type": "topics", "topics": [{**ROBOT, "publishers": 0}]})
    wait_for_topics(page, 1)
    page.select_option("#topic", "/robot_description")
    page.click("#add-display")
    fake.wait_for(lambda c: c["type"] == "add")
    fake.tell({"type": "topics", "topics": [ROBOT, SCAN]})
    wait_for_topics(page, 2)
    assert shown(page) == ["/robot_description"]
    assert len(added(fake, kind="robot_model")) == 1


def test_a_display_that_is_added_twice_is_there_once(fake, open_view):
    page = open_view(fake.url)
    fake.tell({"type": "topics", "topics": [SCAN]})
    wait_for_topics(page, 1)
    page.click("#add-display")
    fake.wait_for(lambda c: c["type"] == "add" and c["topic"] == "/scan")
    page.click("[aria-label='Hide /scan']")
    page.click("#add-display")  # shows it again
    assert shown(page) == ["/scan"]
    assert page.get_attribute("[aria-label='Hide /scan']", "aria-pressed") == "false"
    page.select_option("#topic", label="robot from a parameter or file")
    page.dblclick("#add-display")
    fake.wait_for(lambda c: c["type"] == "add" and c["kind"] == "robot_model")
    assert shown(page) == ["/scan", "robot model"]
    page.locator("#display-list summary").last.click()
    node = page.get_by_label("Node of the parameter")
    node.fill("/other")
    node.press("Enter")
    page.click("#add-display")
    assert shown(page) == ["/scan", "robot model", "robot model"]
    assert len(added(fake, topic="/scan")) == 1


@pytest.mark.parametrize("displays", [[], [{"kind": "laser_scan", "topic": "/scan"}]])
def test_a_loaded_view_says_itself_what_is_shown(fake, open_view, displays):
    view = {
        "type": "view",
        "fixed": "",
        "displays": displays,
        "show": {},
        "text": "",
        "first": True,
    }
    fake.tell(view)
    page = open_view(fake.url)
    fake.tell({"type": "topics", "topics": [ROBOT, SCAN]})
    wait_for_topics(page, 2)
    assert shown(page) == [each["topic"] for each in displays]
    assert added(fake, kind="robot_model") == []


def test_a_robot_on_the_wire_comes_to_a_page_that_is_open(robot, viewer, open_view):
    page = open_view(viewer.url)
    robot.send("base", "tip", (0, 1, 0), 0, static=True)
    page.wait_for_selector("#tree .row:has-text('tip')")
    latched = QoS(durability=Durability.TRANSIENT_LOCAL)
    described = robot.publisher("/robot_description", "std_msgs/msg/String", latched)
    text = URDF.format(mesh="package://missing/tip.stl")
    described.publish(msg.serialize(msg.get_message("std_msgs/msg/String")(data=text)))
    page.wait_for_selector("#display-list .title b:text-is('/robot_description')")
    page.wait_for_selector("#display-list .status:has-text('package://missing/tip.stl')")
