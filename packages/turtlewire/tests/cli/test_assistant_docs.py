"""docs/how-to/assistant.md does what it says."""

from __future__ import annotations

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

from turtlewire.cli.assistant.permissions import LONGEST_ANSWER
from turtlewire.cli.main import main

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
