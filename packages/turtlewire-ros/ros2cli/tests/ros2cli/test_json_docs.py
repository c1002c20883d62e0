"""The commands of docs/reference/ros2_json.md."""

from __future__ import annotations

import re
from functools import partial

import pytest
from tests.how_to import blocks, wait_until_printed
from tests.places import PATH, ROOT

from ros2cli.main import make_parser

PAGE = (ROOT / "docs" / "reference" / "ros2_json.md").read_text()
BLOCKS = blocks(PAGE)


def test_the_page_shows_what_the_commands_print(run):
    assert len(BLOCKS) == 11
    (_, start), *others = BLOCKS
    start = start.removesuffix(" &\n")
    run("bash", "-c", f"exec {start}", environment={"PATH": PATH}).wait_for("Spawning turtle")
    for (_, command), (kind, text) in zip(others[::2], others[1::2], strict=True):
        assert kind == "text"
        wait_until_printed(text, partial(printed, run, command))


def printed(run, command):
    program = run("bash", "-c", command, environment={"PATH": PATH})
    program.wait()
    return f"{program.text}\n"


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
