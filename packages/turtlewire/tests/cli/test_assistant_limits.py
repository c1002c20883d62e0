"""What an assistant may use, how often, and how long its answers are; without a network.

docs/how-to/assistant.md does what it says.
"""

import json
import os
import re
import subprocess
import sys

import anyio
import pytest
from mcp import Client, StdioServerParameters, stdio_client
from tests.how_to import blocks_of
from tests.places import HOW_TO, PATH

from turtlewire import msg
from turtlewire.cli.assistant.permissions import (
    LONGEST_ANSWER,
    Permissions,
    RateLimit,
    RefusedCallError,
    bounded_json,
    seconds_within,
)
from turtlewire.cli.assistant.plots import number_at
from turtlewire.cli.main import main


class Clock:
    def __init__(self):
        self.now = 1000.0

    def __call__(self):
        return self.now


def test_a_call_too_many_says_when_the_next_one_is_answered():
    clock = Clock()
    limit = RateLimit(2, clock)
    limit.count()
    clock.now += 10.0
    limit.count()
    clock.now += 5.0
    for _ in range(3):  # refused calls do not count
        with pytest.raises(RefusedCallError, match=r"2 in a minute .* Try again in 45\.0 s"):
            limit.count()
    clock.now += 44.9
    with pytest.raises(RefusedCallError, match=r"Try again in 0\.1 s"):
        limit.count()
    clock.now += 0.1
    limit.count()
    with pytest.raises(RefusedCallError, match=r"Try again in 10\.0 s"):
        limit.count()


def test_names_are_allowed_as_a_whole_or_by_their_beginning():
    permissions = Permissions(["/spawn", "turtle1/*"])
    assert permissions.allow("/spawn")
    assert permissions.allow("/turtle1/cmd_vel")
    assert not permissions.allow("/spawn2")
    assert not permissions.allow("/turtle10/cmd_vel")
    assert not Permissions().allow("/spawn")
    assert Permissions(["*"]).allow("/anything")


def test_a_refusal_names_what_is_allowed_and_the_words_to_type():
    with pytest.raises(RefusedCallError) as error:
        Permissions(["/spawn"]).require("/kill", "call")
    assert str(error.value) == (
        "Refused to call /kill. Allowed: /spawn. Only the person who starts this server can allow "
        "more: turtlewire mcp --allow /kill"
    )
    with pytest.raises(RefusedCallError, match=r"Allowed: nothing\..* --allow '/a;b'$"):
        Permissions().require("/a;b", "call")


@pytest.mark.parametrize("pattern", ["", "/a*b", "**"])
def test_a_star_is_only_at_the_end(pattern):
    with pytest.raises(ValueError, match=r"such as '/turtle1/\*'"):
        Permissions([pattern])


@pytest.mark.parametrize("seconds", [0.0, -1.0, 5.1, float("nan"), float("inf")])
def test_durations_have_a_limit(seconds):
    with pytest.raises(RefusedCallError, match="it must be above 0 and at most 5 seconds"):
        seconds_within(seconds, "duration_s", 5.0)
    assert seconds_within(5.0, "duration_s", 5.0) == 5.0


def test_short_answers_are_complete():
    value = {"a": [1, 2.5, None, True], "b": {"c": "text"}}
    assert json.loads(bounded_json(value)) == value


@pytest.mark.parametrize(
    "value",
    [
        {"data": list(range(1_000_000))},
        {"data": "x" * 1_000_000},
        [[list(range(300)) for _ in range(300)] for _ in range(9)],
        {"names": [f"/{'long' * 60}{number}" for number in range(5000)]},
    ],
)
def test_long_answers_are_cut_and_say_so(value):
    text = bounded_json(value)
    assert len(text) <= LONGEST_ANSWER
    note, _, cut = text.partition("\n")
    assert note.startswith("(shortened: ")
    assert "more" in text
    json.loads(cut)


def test_an_answer_of_too_many_keys_is_cut_at_its_end():
    text = bounded_json({f"key{number}": number for number in range(10_000)})
    assert len(text) <= LONGEST_ANSWER
    assert text.endswith("... (the end is left out)")


def test_numbers_in_fields():
    scan = msg.get_message("sensor_msgs/msg/LaserScan")(ranges=[1.0, 2.5], angle_min=-1.0)
    assert number_at(scan, "ranges[1]") == 2.5
    assert number_at(scan, "angle_min") == -1.0
    assert number_at(scan, "header.stamp.sec") == 0.0
    imu = msg.get_message("sensor_msgs/msg/Imu")(orientation_covariance=[0.5] * 9)
    assert number_at(imu, "orientation_covariance[8]") == 0.5


@pytest.mark.parametrize(
    ("path", "reason"),
    [
        ("linear.w", r"linear.w: geometry_msgs/msg/Vector3 has no field w. Its fields: x, y, z"),
        ("liner.x", r"no field liner. Did you mean: linear. Its fields: linear, angular"),
        ("linear", r"linear is not a number, but geometry_msgs/msg/Vector3. Its fields: x, y, z"),
        ("linear[0]", r"\[0\] follows geometry_msgs/msg/Vector3, which is not a list"),
        ("linear.x.y", r"a value of the type float has no field y"),
        ("linear x", r"is not a field: write names with dots"),
        ("", r" is not a number, but geometry_msgs/msg/Twist"),
        ("__class__", r"is not a field"),
    ],
)
def test_fields_that_are_no_numbers(path, reason):
    with pytest.raises(RefusedCallError, match=reason):
        number_at(msg.get_message("geometry_msgs/msg/Twist")(), path)


PAGE = (HOW_TO / "assistant.md").read_text(encoding="utf-8")
ENVIRONMENT = {**os.environ, "PATH": PATH}


def test_the_search_words_stand_in_the_first_line():
    assert "assistant (MCP)" in PAGE.splitlines()[0]
    assert "ROS 2 robot" in PAGE.splitlines()[0]


def test_the_configuration_starts_the_server_with_the_tools_of_the_page():
    (configuration,) = blocks_of(PAGE, "json")
    (entry,) = json.loads(configuration)["mcpServers"].values()
    assert list(entry) == ["command", "args", "env"]
    table = PAGE.partition("| tool | does |")[2].partition("\n\n")[0]
    named = set(re.findall(r"`(\w+)`", "".join(re.findall(r"^\| (.*?) \|", table, re.MULTILINE))))

    async def session():
        server = StdioServerParameters(
            command=entry["command"], args=entry["args"], env={**entry["env"], **ENVIRONMENT}
        )
        async with Client(stdio_client(server)) as client:
            assert {tool.name for tool in (await client.list_tools()).tools} == named
            assert entry["args"][-1] in client.instructions

    anyio.run(session)


@pytest.mark.slow
def test_the_program_prints_what_the_page_says(run):
    node = run("ros2", "run", "turtlesim", "turtlesim_node", "--headless", environment=ENVIRONMENT)
    node.wait_for("Spawning turtle")
    (program,) = blocks_of(PAGE, "python")
    said = subprocess.run(
        [sys.executable, "-c", program],
        check=True,
        stdout=subprocess.PIPE,
        text=True,
        env=ENVIRONMENT,
    ).stdout
    assert said == blocks_of(PAGE, "text")[-1]


def test_the_refusal_and_the_limit_are_those_of_the_server(run):
    refusal = " ".join(blocks_of(PAGE, "text")[0].split())

    async def session():
        server = StdioServerParameters(command="turtlewire", args=["mcp"], env=ENVIRONMENT)
        async with Client(stdio_client(server)) as client:
            answer = await client.call_tool("drive", {"topic": "/turtle1/cmd_vel"})
            assert answer.content[0].text == f"Error executing tool drive: {refusal}"

    node = run("ros2", "run", "turtlesim", "turtlesim_node", "--headless", environment=ENVIRONMENT)
    node.wait_for("Spawning turtle")
    anyio.run(session)
    assert f"at most {LONGEST_ANSWER:,} characters" in PAGE


def test_the_page_names_every_option(capsys):
    with pytest.raises(SystemExit):
        main(["mcp", "--help"])
    options = set(re.findall(r"--[a-z]+", capsys.readouterr().out)) - {"--help"}
    assert options == set(re.findall(r"^\| `(--[a-z]+) ", PAGE, re.MULTILINE))
