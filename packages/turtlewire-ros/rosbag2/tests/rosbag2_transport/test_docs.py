"""The commands of the how-to page about recording and playing, run."""

import sys

import pytest
from tests.how_to import blocks
from tests.places import HOW_TO, PATH

from turtlewire.bag import open_bag

from .conftest import end, wait_until_written

PAGE = HOW_TO / "record_and_play.md"


@pytest.fixture
def shell(run, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", PATH)
    return lambda line: run("bash", "-c", f"exec {line}", cwd=tmp_path)


@pytest.mark.slow
def test_the_page_does_what_it_says(shell, run, tmp_path):
    found = blocks(PAGE.read_text())
    assert len(found) == 11
    for kind, text in found:
        if kind == "yaml":
            (tmp_path / "wanted.yaml").write_text(text)
        elif kind == "python":
            assert run(sys.executable, "-c", text, cwd=tmp_path).wait() == 0
        else:
            assert kind == "sh"
            for line in text.splitlines():
                do(shell, line, tmp_path)
    with open_bag(tmp_path / "only_tf") as bag:
        assert list(bag.topics) == ["/tf_static"]
        assert len(bag) == 1


def do(shell, line, folder):
    """Run a line; Ctrl-C for a recorder when it has received something of each topic."""
    if line.endswith(" &"):
        shell(line.removesuffix(" &"))
        return
    program = shell(line)
    if line.startswith("ros2 bag record"):
        program.wait_for("All requested topics are subscribed")
        wait_until_written(folder / "my_bag", "/chatter", 9)
        assert end(program) == 0
        return
    assert program.wait() == 0, program.text
    if line.startswith("ros2 bag info my_bag"):
        assert "Topic: /chatter | Type: std_msgs/msg/String" in program.text
