"""The commands of docs/reference/ros2_json.md."""

import os
import re
from functools import partial

import pytest
from tests.how_to import blocks, blocks_of, wait_until_printed
from tests.needs import needs_cyclone_dds
from tests.places import HOW_TO, PATH, ROOT

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


# The commands of docs/how-to/relay.md.


RELAY = (HOW_TO / "relay.md").read_text()


def with_domains(far):
    """The page with the domains of this test."""
    page = RELAY.replace("cyclonedds:0", f"cyclonedds:{os.environ['ROS_DOMAIN_ID']}")
    return page.replace("zenoh:7", f"zenoh:{far}").replace("DOMAIN_ID=7", f"DOMAIN_ID={far}")


@needs_cyclone_dds
def test_the_robot_is_used_from_the_other_network(run, other_domain):
    start, use, _ = blocks_of(with_domains(other_domain), "sh")
    environment = {"PATH": PATH, "RMW_IMPLEMENTATION": ""}
    node, relay = (
        run("bash", "-c", f"exec {line.removesuffix(' &')}", environment=environment)
        for line in start.splitlines()
    )
    relay.wait_for(r"/turtlesim/get_parameters ->")
    user = run("bash", "-ec", use, environment=environment)
    assert user.wait() == 0, user.text
    (printed,) = blocks_of(RELAY, "text")
    assert user.text.endswith(printed.strip())
    assert "Goal finished with status: SUCCEEDED" in user.text
    assert "response:\nturtlesim.srv.Spawn_Response(name='bob')" in user.text
    assert "Traceback" not in node.text + relay.text


def test_the_page_names_every_option(run):
    program = run("turtlewire", "relay", "--help", environment={"PATH": PATH})
    assert program.wait() == 0
    options = set(re.findall(r"--[a-z][a-z-]*", program.text)) - {"--help"}
    assert options
    assert all(f"`{option} " in RELAY for option in options), options
