"""The `turtlewire` command line: help, version, wrong words and completion."""

import os
import subprocess
from importlib.metadata import entry_points, version
from pathlib import Path

import pytest
from tests.places import TURTLEWIRE
from tests.programs import run_python

from tests import places
from turtlewire import msg, wire
from turtlewire.cli.bag_commands import what_to_do_with_bag
from turtlewire.cli.main import main
from turtlewire.tf.listener import STATIC_QOS
from turtlewire.wire.base import TypeId

BAG = places.GOLDEN / "bag/d_mcap"
SHOW_BAG = f"Its transforms: turtlewire bag tf {BAG}; what is in it: turtlewire bag info {BAG}; "
TF = TypeId("tf2_msgs/msg/TFMessage", msg.type_hash("tf2_msgs/msg/TFMessage"))


@pytest.mark.parametrize(
    ("words", "status", "text"),
    [
        ("doctr", 2, "Did you mean: doctor"),
        ("frames --onc", 2, "Did you mean: --once"),
        ("frames --vresion", 2, "turtlewire frames: error: unrecognized arguments: --vresion"),
        ("--vresion", 2, "Did you mean: --version"),
        ("doctor --listen soon", 2, "'soon' is not a number of seconds, above 0 and up to 3600"),
        ("doctor now", 2, "turtlewire doctor: there is no bag at now"),
        ("doctor now then", 2, "unrecognized arguments: then"),
        ("frames a b", 2, "unrecognized arguments: b"),
        ("lesson", 2, "scripts/lesson --serve"),
        ("demo", 2, "python -m turtlewire.demo"),
        (f"frames {BAG}", 2, f"turtlewire frames: error: {BAG} is a bag. {SHOW_BAG}"),
        (f"bag {BAG}", 2, f"\n{BAG} is a bag. {SHOW_BAG}"),
        (f"{BAG}", 2, f"\n{BAG} is a bag. {SHOW_BAG}"),
        ("bag fts", 2, "turtlewire bag: error: argument COMMAND: invalid choice: 'fts'"),
        ("doctor --topic a//b --listen 0.1", 2, "turtlewire doctor: create subscription '/a//b'"),
        ("doctr", 2, "usage: turtlewire [-h] [--version] COMMAND ...\n"),
        ("bag x", 2, "usage: turtlewire bag [-h] COMMAND ...\n"),
        ("", 0, "usage: turtlewire [-h] [--version]"),
        ("--version", 0, f"turtlewire {version('turtlewire')}\n"),
    ],
)
def test_command_lines(words, status, text, capsys):
    try:
        found = main(words.split())
    except SystemExit as end:
        found = end.code
    said = capsys.readouterr()
    assert found == status
    assert text in (said.err if status else said.out)
    assert not (said.out if status else said.err)


INTERRUPTED_IMPORT = """
import os, signal, sys

class Interrupting:
    def find_spec(self, name, path=None, target=None):
        if name == "turtlewire.cli.bag_commands":
            os.kill(os.getpid(), signal.SIGINT)

sys.meta_path.insert(0, Interrupting())
from turtlewire.cli.start import main
sys.exit(main())
"""


@pytest.mark.skipif(os.name == "nt", reason="Windows has no signal for one process")
def test_ctrl_c_during_the_imports_shows_no_traceback():
    program = run_python(INTERRUPTED_IMPORT, check=False)
    assert (program.returncode, program.stdout, program.stderr) == (130, "", "")


def test_the_installed_command_starts_where_ctrl_c_is_handled():
    (command,) = entry_points(group="console_scripts", name="turtlewire")
    assert command.value == "turtlewire.cli.start:main"


def offered(line, answers):
    """The words that the shell gets for TAB at the end of a line."""
    environment = {
        "_ARGCOMPLETE": "1",
        "_ARGCOMPLETE_IFS": "\n",
        "_ARGCOMPLETE_STDOUT_FILENAME": str(answers),
        "COMP_LINE": line,
        "COMP_POINT": str(len(line)),
        "COMP_TYPE": "9",
    }
    subprocess.run([TURTLEWIRE], env={**os.environ, **environment}, check=True, timeout=300)
    return [word.strip() for word in answers.read_text().split("\n") if word.strip()]


@pytest.mark.parametrize(
    ("line", "words"),
    [
        (
            "turtlewire ",
            [
                "--version",
                *("bag", "class", "compare", "doctor", "foxglove", "frames", "graph", "mcp"),
                *("relay", "trajectory", "view"),
            ],
        ),
        ("turtlewire d", ["doctor"]),
        ("turtlewire doctor --", ["--json", "--listen", "--static-topic", "--topic"]),
        ("turtlewire doctor --l", ["--listen"]),
        (
            "turtlewire doctor ",  # bags, and no other files
            ["--json", "--listen", "--static-topic", "--topic", "my_bag/"],
        ),
        ("turtlewire frames --p", ["--period"]),
    ],
)
def test_completion_of_words(line, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "notes.txt").touch()
    (tmp_path / "my_bag").mkdir()
    assert sorted(offered(line, tmp_path / "answers")) == words


def test_completion_of_frames(tmp_path):
    context = wire.open_context()
    message = msg.get_message("tf2_msgs/msg/TFMessage")()
    transform = msg.get_message("geometry_msgs/msg/TransformStamped")(child_frame_id="robot")
    transform.header.frame_id = "world"
    message.transforms.append(transform)
    publisher = context.create_node("one").create_publisher("/tf_static", TF, STATIC_QOS)
    publisher.publish(msg.serialize(message))
    try:
        for _ in range(20):  # a TAB gives up soon, too soon beside much load
            if found := offered("turtlewire frames ro", tmp_path / "answers"):
                break
        assert found == ["robot"]
    finally:
        context.close()


def test_a_folder_named_as_a_frame_is_no_bag(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("world").mkdir()
    Path("world", "notes.txt").touch()
    assert what_to_do_with_bag("world") == ""
    Path("world", "world_0.mcap").touch()
    assert what_to_do_with_bag("world").startswith("world is a bag.")
    assert what_to_do_with_bag("nothing.mcap") == ""
