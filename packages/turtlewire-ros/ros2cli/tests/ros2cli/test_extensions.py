"""`ros2 extensions`, `ros2 extension_points` and `ros2 doctor hello`."""

from __future__ import annotations

import re
import sys

import pytest

from ros2cli.installed import declared
from ros2cli.main import main, make_parser
from ros2doctor.verb.hello import _Hello

ROS2 = "from ros2cli.main import main; import sys; sys.exit(main(sys.argv[1:]))"


def test_every_command_and_verb_is_listed(capsys):
    assert main(["extensions"]) == 0
    listed = capsys.readouterr().out
    for command in declared("ros2cli.command"):
        assert f"\n  {command}: " in listed
    assert "ros2doctor.verb\n  hello: " in listed
    assert main(["extensions", "-v"]) == 0
    assert "    module: ros2topic.verb.echo\n" in capsys.readouterr().out


def test_every_extension_point_is_listed(capsys):
    assert main(["extension_points"]) == 0
    points = capsys.readouterr().out.splitlines()
    assert main(["extensions"]) == 0
    titles = [line for line in capsys.readouterr().out.splitlines() if line[0] != " "]
    assert [point.partition(":")[0] for point in points] == titles


class FakeGroup:
    """A group in which two others speak."""

    def __init__(self):
        self.sent = []

    def send(self, data):
        self.sent.append(data)

    def received(self):
        yield self.sent[-1], ("127.0.0.1", 1)
        yield b"hello, it's me moon", ("127.0.0.1", 2)
        yield b"", ("127.0.0.1", 3)


def test_the_table_counts_other_hosts():
    args = make_parser(["doctor", "hello"]).parse_args(["doctor", "hello"])
    hello = _Hello(args, FakeGroup())
    hello.greet()
    hello.greet()
    hello.hear("topic", "hello, it's me mars")
    hello.hear("topic", hello.greeting)
    table = hello.table()
    assert table.startswith("Greetings sent: 2\nTopic /canyouhearme: heard 1 other hosts\n")
    assert re.search(r"mars +1\n", table)
    assert re.search(r"moon +2\n", table)
    assert "heard 0 other hosts" in hello.table()


def test_hello_ends_after_a_table(run):
    verb = run(sys.executable, "-c", ROS2, "doctor", "hello", "--once", "-pp", "0.2")
    verb.wait()
    assert verb.process.returncode == 0 or "Network is unreachable" in verb.text, verb.text


def test_unknown_options_show_the_usage_of_the_verb(capsys):
    with pytest.raises(SystemExit) as end:
        main(["topic", "list", "--nope"])
    assert end.value.code == 2
    told = capsys.readouterr().err
    assert told.startswith("usage: ros2 topic list [-h]")
    assert "ros2 topic list: error: unrecognized arguments: --nope" in told
