"""The commands of docs/reference/ros2_json.md."""

from __future__ import annotations

import doctest
import os
import re
import sys
import time
from pathlib import Path

import pytest
from tests.places import ROOT

from ros2cli.main import make_parser

PAGE = (ROOT / "docs" / "reference" / "ros2_json.md").read_text()
PATH = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)


def test_the_page_shows_what_the_commands_print(run):
    assert len(BLOCKS) == 11
    (_, start), *others = BLOCKS
    start = start.removesuffix(" &\n")
    run("bash", "-c", f"exec {start}", environment={"PATH": PATH}).wait_for("Spawning turtle")
    for (_, command), (kind, text) in zip(others[::2], others[1::2], strict=True):
        assert kind == "text"
        wait_until_printed(run, command, text)


def wait_until_printed(run, command, text):
    """Repeat a command until it prints the text: a busy machine may not find the node at once."""
    limit = time.monotonic() + 60
    while True:
        program = run("bash", "-c", command, environment={"PATH": PATH})
        program.wait()
        if doctest.OutputChecker().check_output(text, f"{program.text}\n", doctest.ELLIPSIS):
            return
        assert time.monotonic() < limit, program.text


VERBS = [
    verb
    for row in re.findall(r"^\| (`\w+ \w+`(?:, `\w+ \w+`)*) \|", PAGE, re.MULTILINE)
    for verb in re.findall(r"`(\w+ \w+)`", row)
]


@pytest.mark.parametrize("verb", VERBS)
def test_each_verb_of_the_page_has_the_option(verb):
    words = verb.split()
    with pytest.raises(SystemExit) as end:
        make_parser(words).parse_args([*words, "--json", "--help"])
    assert end.value.code == 0


def test_the_page_has_all_verbs():
    assert len(VERBS) == len(set(VERBS)) == 18
