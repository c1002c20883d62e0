"""The commands of docs/how-to/relay.md."""

from __future__ import annotations

import os
import re

from tests.how_to import blocks_of
from tests.needs import needs_cyclone_dds
from tests.places import HOW_TO, PATH

PAGE = (HOW_TO / "relay.md").read_text()


def with_domains(far):
    """The page with the domains of this test."""
    page = PAGE.replace("cyclonedds:0", f"cyclonedds:{os.environ['ROS_DOMAIN_ID']}")
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
    (printed,) = blocks_of(PAGE, "text")
    assert user.text.endswith(printed.strip())
    assert "Goal finished with status: SUCCEEDED" in user.text
    assert "response:\nturtlesim.srv.Spawn_Response(name='bob')" in user.text
    assert "Traceback" not in node.text + relay.text


def test_the_page_names_every_option(run):
    program = run("turtlewire", "relay", "--help", environment={"PATH": PATH})
    assert program.wait() == 0
    options = set(re.findall(r"--[a-z][a-z-]*", program.text)) - {"--help"}
    assert options
    assert all(f"`{option} " in PAGE for option in options), options
