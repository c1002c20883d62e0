"""docs/how-to/graph.md does what it says."""

from __future__ import annotations

import json
import os
import re
import subprocess

from tests.places import BIN, HOW_TO, PATH

from turtlewire_view.graph.files import as_data
from turtlewire_view.graph.picture import Selection

from .pictures import robot

PAGE = (HOW_TO / "graph.md").read_text(encoding="utf-8")


def test_the_search_words_stand_in_the_first_line():
    assert "rqt_graph without ROS" in PAGE.splitlines()[0]


def test_the_commands_print_what_the_page_says(run, tmp_path):
    examples = re.findall(r"```sh\n(.*?)```\n\n```text\n(.*?)```", PAGE, re.DOTALL)
    assert len(examples) == 2
    environment = {**os.environ, "PATH": PATH}
    for commands, expected in examples:
        said = ""
        for line in commands.splitlines():
            if line.endswith("&"):
                run(*[BIN / "ros2", *line.split()[1:-1]]).wait_for("Spawning turtle")
                continue
            said += subprocess.run(
                line, shell=True, check=True, capture_output=True, text=True, cwd=tmp_path,
                env=environment,
            ).stdout  # fmt: skip
        assert said == expected


def test_the_keys_are_those_of_the_file():
    data = json.loads(json.dumps(as_data(robot().picture(), Selection())))
    rows = re.findall(r"^\| `(\w+)` \| (.*) \|$", PAGE.partition("| key |")[2], re.MULTILINE)
    assert [name for name, _ in rows] == [*data]
    for name, text in rows:
        if isinstance(data[name], list):
            assert [key for key in data[name][0] if f"`{key}`" not in text] == []
