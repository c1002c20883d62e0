"""docs/how-to/foxglove.md does what it says."""

import re
import shlex
import sys

from tests.how_to import blocks_of
from tests.places import BIN, HOW_TO

from turtlewire.wire.qos import Durability

PAGE = (HOW_TO / "foxglove.md").read_text()


def test_the_commands_of_the_page_start(run):
    commands = [shlex.split(line) for block in blocks_of(PAGE, "sh") for line in block.splitlines()]
    commands += [shlex.split(line) for line in re.findall(r"`(turtlewire foxglove [^`]+)`", PAGE)]
    assert len(commands) == 8
    first = commands[0]
    for words in commands:
        if words[0] == "ros2":
            continue  # test_foxglove_bridge.py launches it
        program = run(BIN / words[0], *words[1:], *([] if "--port" in words else ["--port", "0"]))
        (said,) = program.wait_for(
            r"^Foxglove and Lichtblick connect to ws://.*:\d+ \(Ctrl-C ends\)$"
        )
        if words == first:
            assert re.sub(r":\d+ ", ":8765 ", said[0]) + "\n" == blocks_of(PAGE, "text")[0]
        program.kill()


def test_the_client_of_the_page(serve, robot, run, tmp_path):
    robot.say(robot.publisher("/greeting", durability=Durability.TRANSIENT_LOCAL), "hello")
    (tmp_path / "client.py").write_text(blocks_of(PAGE, "python")[0])
    program = run(sys.executable, tmp_path / "client.py", serve().url, "/greeting")
    program.wait_for("^hello$")
    assert program.wait() == 0
