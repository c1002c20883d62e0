"""Messages and logs of a real robot_state_publisher (`tests/golden/robots`), and of ours.

Kinematics, parameters, descriptions, refusals and exit codes are equal. Log lines are equal too;
ours adds some (see `docs/compatibility.md`), and the tests check that they are there.
"""

import hashlib
import json
import math
import re
import sys
from pathlib import Path

import pytest

from sensor_msgs.msg import JointState
from tests import archive, places

GOLDEN = places.GOLDEN / "robots"
SCENARIOS = {each["name"]: each for each in json.loads((GOLDEN / "rsp/scenarios.json").read_text())}
ANSWERS = archive.read(GOLDEN / "rsp/answers.txt")
URDF = archive.read(GOLDEN / "urdf.txt")
INVALID = archive.read(GOLDEN / "invalid.txt")
REFUSED = json.loads(INVALID["expected.json"].content)
STARTUPS = {each["name"]: each for each in json.loads((GOLDEN / "rsp/startups.json").read_text())}
STARTED = json.loads((GOLDEN / "rsp/startups.expected.json").read_text())

#: Cases that differ; the table says why.
DEVIATIONS = re.findall(
    r"^\| rsp (\w+) log \|", (GOLDEN / "DEVIATIONS.md").read_text(), re.MULTILINE
)

TOLERANCE = 1e-9
ADDED = ("Skipping joint states", "The joint '")
#: Of a new description, kdl_parser's warnings come twice in ROS 2, once here.
WARNED_TWICE = {"change_sluice_raft"}


def text_of(name):
    return URDF[f"{name}.urdf"].content.decode()


def golden(name):
    return json.loads(ANSWERS[name].content)


def row(transform, *, static):
    stamp, moved = transform.header.stamp, transform.transform
    t, q = moved.translation, moved.rotation
    return [
        transform.header.frame_id,
        transform.child_frame_id,
        "now" if static else [stamp.sec, stamp.nanosec],
        [t.x, t.y, t.z],
        [q.x, q.y, q.z, q.w],
    ]


def close(found, wanted, sign=1.0):
    return all(
        math.isclose(a, sign * b, rel_tol=TOLERANCE, abs_tol=TOLERANCE)
        for a, b in zip(found, wanted, strict=True)
    )


def same_transforms(messages, wanted, *, static=False):
    found = [[row(each, static=static) for each in message.transforms] for message in messages]
    frames = [[each[:3] for each in message] for message in found]
    assert frames == [[each[:3] for each in message] for message in wanted]
    for message, expected in zip(found, wanted, strict=True):
        for (*_, t, q), (*_, wanted_t, wanted_q) in zip(message, expected, strict=True):
            assert close(t, wanted_t)
            assert close(q, wanted_q) or close(q, wanted_q, -1.0)  # the same rotation


def same_descriptions(messages, wanted):
    texts = [message.data.encode() for message in messages]
    assert [[len(text), hashlib.sha256(text).hexdigest()] for text in texts] == wanted


def joint_state(step):
    message = JointState(name=step["name"], position=step["position"])
    message.velocity, message.effort = step.get("velocity", []), step.get("effort", [])
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(step["ns"], 10**9)
    return message


def log_lines(text):
    """Without times, colours, places, and hints, which are indented."""
    text = re.sub(r"\x1b\[[0-9;]*m", "", text)
    lines = [re.sub(r"^\[(\w+)\] \[\d+\.\d+\] ", r"[\1] ", line) for line in text.splitlines()]
    kept = [line for line in lines if line.strip() and not line.startswith((" ", "[ros2run]"))]
    return [re.sub(r"^(Error|Warning):\s+", r"\1: ", line) for line in kept]


def play(rig, step, wanted):
    if step["op"] == "joint_states":
        rig.send(joint_state(step))
        same_transforms(rig.transforms(), wanted["tf"])
    elif step["op"] == "clock":
        rig.set_clock(step["ns"])
    else:
        rig.static.clear()
        rig.descriptions.clear()
        value = text_of(step["urdf"]) if "urdf" in step else step["value"]
        assert [rig.set_parameter(step["name"], value)] == wanted["result"]
        if "tf_static" in wanted:
            rig.spin_until(lambda: rig.static and rig.descriptions)
            same_transforms(rig.static, wanted["tf_static"], static=True)
            same_descriptions(rig.descriptions, wanted["description"])


@pytest.mark.parametrize("name", [name for name in SCENARIOS if not SCENARIOS[name]["as_argument"]])
def test_scenario(name, rig, capfd):
    scenario, wanted = SCENARIOS[name], golden(name)
    player = rig(text_of(scenario["urdf"]), **scenario["parameters"])
    same_transforms(player.static, wanted["start"]["tf_static"], static=True)
    same_descriptions(player.descriptions, wanted["start"]["description"])
    for step, result in zip(scenario["steps"], wanted["steps"], strict=True):
        play(player, step, result)
    lines = log_lines(capfd.readouterr().err)
    assert (lines != wanted["log"]) == (name in DEVIATIONS)
    said = [line for line in lines if not any(text in line for text in ADDED)]
    if name in WARNED_TWICE:
        assert said == once(wanted["log"])
    else:
        assert said == wanted["log"]


def once(log):
    """The log without the first round of kdl_parser's warnings."""
    first = next(number for number, line in enumerate(log) if "[kdl_parser]" in line)
    warnings = sum("[kdl_parser]" in line for line in log) // 2
    return log[:first] + log[first + warnings :]


def test_all_scenarios_are_there():
    assert len(SCENARIOS) == 11
    assert len(DEVIATIONS) == 8
    assert sum(len(each["steps"]) for each in SCENARIOS.values()) == 211


def started(run, tmp_path, parameters, *arguments):
    words = [Path(sys.executable).parent / "ros2", "run"]
    words += ["robot_state_publisher", "robot_state_publisher", *arguments]
    if parameters:
        lines = [f"    {key}: {json.dumps(value)}" for key, value in parameters.items()]
        path = tmp_path / "parameters.yaml"
        path.write_text("\n".join(["/**:", "  ros__parameters:", *lines]) + "\n")
        words += ["--ros-args", "--params-file", path]
    return run(*words, cwd=tmp_path)


@pytest.mark.parametrize("name", sorted(REFUSED))
def test_a_description_that_urdfdom_refuses(name, run, tmp_path):
    text = INVALID[f"{name}.urdf"].content.decode()
    program = started(run, tmp_path, {"robot_description": text})
    assert program.wait() != 0
    assert log_lines(program.text) == REFUSED[name]["log"]
    assert re.search(r"^         at line \d+ in <", program.text, re.MULTILINE)
    assert "Traceback" not in program.text


def test_a_bad_mesh_keeps_the_node_running(run, tmp_path):
    """urdfdom logs the fault of a link and goes on, as Debian's does."""
    mesh = "<visual><geometry><mesh scale='1 1 1'/></geometry></visual>"
    text = f"<robot name='r'><link name='a'>{mesh}</link></robot>"
    program = started(run, tmp_path, {"robot_description": text})
    program.wait_for("Robot initialized")
    assert log_lines(program.text) == [
        "Error: Mesh must contain a filename attribute",
        "Error: Could not parse visual element for Link [a]",
        "[INFO] [robot_state_publisher]: Robot initialized",
    ]


@pytest.mark.parametrize("name", sorted(STARTUPS))
def test_a_wrong_start(name, run, tmp_path):
    startup = STARTUPS[name]
    parameters = dict(startup.get("parameters", {}))
    if "urdf" in startup:
        parameters["robot_description"] = text_of(startup["urdf"])
    program = started(run, tmp_path, parameters)
    assert program.wait() != 0
    assert log_lines(program.text) == STARTED[name]["log"]


def test_a_file_as_argument(run, tmp_path):
    (tmp_path / "robot.urdf").write_text(text_of("pebble"))
    program = started(run, tmp_path, {}, "robot.urdf")
    program.wait_for("Robot initialized")
    assert log_lines(program.text) == golden("pebble_argument")["log"]


def test_a_file_that_is_not_there(run, tmp_path):
    program = started(run, tmp_path, {}, "no_such.urdf")
    assert program.wait() != 0
    assert log_lines(program.text)[-1] == (
        "Failed to open URDF file: no_such.urdf: No such file or directory"
    )
