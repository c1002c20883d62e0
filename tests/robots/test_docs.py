"""The examples of the how-to page about joints, run."""

from __future__ import annotations

import re
import time
from functools import partial

from tests.how_to import blocks, wait_until_printed
from tests.places import BIN, HOW_TO, PATH

from joint_state_publisher.description import JointOptions, read_joints

PAGE = HOW_TO / "robots.md"
#: Commands that the page shows without running them.
ONLY_SHOWN = ("ros2 launch urdf_tutorial", "ros2 launch examples/robots/walker")


def test_the_page_does_what_it_says(run, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", PATH)
    monkeypatch.setenv("TURTLEWIRE_BROWSER", "0")
    monkeypatch.chdir(tmp_path)
    names = iter(re.findall(r"^Save this as `(\S+)`:$", PAGE.read_text(), re.MULTILINE))
    background = []
    checked = 0
    for kind, text in blocks(PAGE.read_text()):
        if kind in {"xml", "python"}:
            (tmp_path / next(names)).write_text(text)
        elif kind == "sh":
            for line in text.splitlines():
                if line.endswith(" &"):
                    background.append(run("bash", "-c", f"exec {line.removesuffix(' &')}"))
                else:
                    printed(run, line)
        elif not text.startswith(ONLY_SHOWN):
            wait_until_printed(text, partial(printed, run, line))
            checked += 1
    assert checked == 2
    background[-1].wait_for(r"The joints' sliders are at http://127\.0\.0\.1:\d+/")
    assert not list(names)


def printed(run, line: str) -> str:
    program = run("bash", "-c", f"exec {line}")
    assert program.wait() == 0, program.text
    return "".join(f"{text}\n" for text in program.text.splitlines() if "[INFO]" not in text)


def test_the_table_names_every_parameter(run, tmp_path):
    model = tmp_path / "one.urdf"
    model.write_text("<robot name='a'><joint name='j' type='continuous'/></robot>")
    assert read_joints(model.read_text(), JointOptions({}, {}), print).order == ["j"]
    node = run(BIN / "ros2", "run", "joint_state_publisher", "joint_state_publisher", model)
    limit = time.monotonic() + 60
    listing = run(BIN / "ros2", "param", "list", "/joint_state_publisher")
    while listing.wait() != 0:  # the node is not there yet
        assert time.monotonic() < limit, node.text
        listing = run(BIN / "ros2", "param", "list", "/joint_state_publisher")
    table = PAGE.read_text().replace("`_velocities`", "`publish_default_velocities`")
    table = table.replace("`_efforts`", "`publish_default_efforts`")
    own = {name.strip() for name in listing.text.splitlines()} - {
        "use_sim_time",
        "start_type_description_service",
    }
    assert own
    assert all(f"`{name}`" in table for name in own), own
