"""Messages of a real joint_state_publisher (`tests/golden/robots/jsp`), and of ours."""

from __future__ import annotations

import json
import re
import time
from typing import TYPE_CHECKING

import pytest

import rclpy
from joint_state_publisher.joint_state_publisher import JointStatePublisher, SettingError, main
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tests import archive, places

if TYPE_CHECKING:
    from pathlib import Path

GOLDEN = places.GOLDEN / "robots"
SCENARIOS = {
    scenario["name"]: scenario
    for scenario in json.loads((GOLDEN / "jsp" / "scenarios.json").read_text())
}
ANSWERS = archive.read(GOLDEN / "jsp" / "answers.txt")
URDF = archive.read(GOLDEN / "urdf.txt")
#: Mended on purpose: the cases that differ.
MENDED = set(re.findall(r"^\| jsp (\w+) ", (GOLDEN / "DEVIATIONS.md").read_text(), re.MULTILINE))
WRONG = {"dependent_wrong"}


def golden(name: str) -> list[dict]:
    return json.loads(ANSWERS[name].content)["messages"]


def without_repeats(messages: list[dict]) -> list[dict]:
    return [m for k, m in enumerate(messages) if k == 0 or m != messages[k - 1]]


class Rig:
    """The node, and another one that hears and feeds it."""

    def __init__(self, context: Context, parameters: dict, file: Path | None = None):
        overrides = [Parameter(name, value=value) for name, value in parameters.items()]
        self.node = Node("joint_state_rig", context=context)
        self.got: list[dict] = []
        self.node.create_subscription(JointState, "/joint_states", self._take, 1000)
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.description = self.node.create_publisher(String, "/robot_description", latched)
        self.publisher = JointStatePublisher(
            None if file is None else str(file), context=context, parameter_overrides=overrides
        )
        self.executor = SingleThreadedExecutor(context=context)
        for node in (self.publisher, self.node):
            self.executor.add_node(node)

    def _take(self, message: JointState) -> None:
        fields = ("name", "position", "velocity", "effort")
        values = {name: list(getattr(message, name)) for name in fields}
        self.got.append(values | {"frame_id": message.header.frame_id})

    def spin_until(self, is_done) -> None:
        deadline = time.monotonic() + 60
        while not is_done():
            assert time.monotonic() < deadline, self.got
            self.executor.spin_once(timeout_sec=1)

    def feed(self, source: dict) -> None:
        """Send a message of one source when four more states have come."""
        publisher = self.node.create_publisher(JointState, source["topic"], 10)
        count = len(self.got)
        self.spin_until(
            lambda: publisher.get_subscription_count() > 0 and len(self.got) >= count + 4
        )
        values = {name: value for name, value in source.items() if name != "topic"}
        publisher.publish(JointState(**values))


@pytest.fixture
def make_rig(tmp_path):
    """Makes rigs from scenarios."""
    context = Context()
    rclpy.init(context=context)

    def make_rig(scenario: dict) -> Rig:
        text = URDF[f"{scenario['urdf']}.urdf"].content.decode()
        file = tmp_path / "robot.urdf"
        file.write_text(text)
        rig = Rig(
            context,
            {"rate": 50, **scenario.get("parameters", {})},
            file if scenario.get("as_argument") else None,
        )
        if not scenario.get("as_argument") and not scenario.get("no_description"):
            rig.spin_until(
                lambda: (
                    rig.description.get_subscription_count() > 0
                    and rig.node.count_publishers("/joint_states") > 0
                )
            )
            rig.description.publish(String(data=text))
        return rig

    yield make_rig
    rclpy.shutdown(context=context)


@pytest.mark.parametrize("name", sorted(SCENARIOS.keys() - MENDED - WRONG))
def test_the_same_messages_as_a_real_one(name, make_rig):
    scenario, wanted = SCENARIOS[name], golden(name)
    rig = make_rig(scenario)
    for source in scenario.get("sources", []):
        rig.feed(source)
    rig.spin_until(lambda: len(without_repeats(rig.got)) >= len(without_repeats(wanted)))
    seen, wanted = without_repeats(rig.got), without_repeats(wanted)
    for ours, theirs in zip(seen, wanted, strict=False):
        assert ours["name"] == theirs["name"]
        for field in ("position", "velocity", "effort"):
            assert ours[field] == pytest.approx(theirs[field], abs=1e-12)


def test_a_wrong_name_below_dependent_joints(make_rig):
    with pytest.raises(SettingError) as caught:
        make_rig(SCENARIOS["dependent_wrong"])
    assert str(caught.value) == (
        "Invalid dependent_joint name 'father' (allowed values are 'parent', 'factor', 'offset')"
    )


def test_dependent_joints_outlive_the_description(make_rig):
    rig = make_rig(SCENARIOS["weaver_dependent"])
    rig.spin_until(lambda: rig.got)
    (theirs,) = golden("weaver_dependent")
    assert rig.got[0]["name"] == theirs["name"]
    assert rig.got[0]["position"] == [*theirs["position"][:-1], 2.5]  # 2 * m_source


def test_a_mimic_of_an_unknown_joint_does_not_end_the_node(make_rig):
    rig = make_rig(SCENARIOS["weaver_ghost_crash"])
    rig.spin_until(lambda: len(rig.got) >= 3)
    state = dict(zip(rig.got[0]["name"], rig.got[0]["position"], strict=True))
    assert state["ghost_mimic"] == 0.0
    assert state["b_chain"] == 0.5


def test_a_wrong_description_leaves_the_robot_as_it_is(make_rig):
    rig = make_rig(SCENARIOS["weaver_chain"])
    rig.spin_until(lambda: rig.got)
    before = rig.got[-1]["name"]
    rig.description.publish(String(data="<robot><joint name='a' type='revolute'/></robot>"))
    count = len(rig.got)
    rig.spin_until(lambda: len(rig.got) >= count + 5)
    assert rig.got[-1]["name"] == before


@pytest.mark.parametrize("rate", [0, -1])
def test_a_rate_is_positive(make_rig, rate):
    with pytest.raises(SettingError, match="'rate' must be greater than 0"):
        make_rig({"urdf": "weaver_sound", "parameters": {"rate": rate}})


def test_a_circle_of_mimics_is_refused(make_rig, tmp_path, capfd):
    limit = "<limit lower='-1' upper='1'/>"
    text = "".join(
        f"<joint name='{a}' type='revolute'>{limit}<mimic joint='{b}'/></joint>"
        for a, b in ("ab", "ba")
    )
    file = tmp_path / "circle.urdf"
    file.write_text(f"<robot>{text}</robot>")
    rig = make_rig({"urdf": "weaver_sound"})
    capfd.readouterr()
    with pytest.raises(SettingError, match=r"infinite recursive mimic chain: \['a', 'b', 'a'\]"):
        JointStatePublisher(str(file), context=rig.node.context)
    capfd.readouterr()
    assert main([str(file)]) == 1
    *_, line = re.sub(r"\[[\d.]+\] ", "", capfd.readouterr().err).splitlines()
    chain = "['a', 'b', 'a']"
    assert line == (
        f"[ERROR] [joint_state_publisher]: Found an infinite recursive mimic chain: {chain}"
    )


@pytest.mark.parametrize(
    ("name", "value", "error"),
    [
        ("rate", "fast", "the parameter 'rate' must be a number, got 'fast'"),
        ("zeros.c_free", "left", "the parameter 'zeros.c_free' must be a number, got 'left'"),
        ("use_mimic_tags", 1, "the parameter 'use_mimic_tags' must be true or false, got 1"),
    ],
)
def test_a_parameter_of_another_type_is_one_error(make_rig, name, value, error):
    with pytest.raises(SettingError) as caught:
        make_rig({"urdf": "weaver_sound", "parameters": {name: value}})
    assert str(caught.value) == error
