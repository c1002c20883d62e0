"""docs/how-to/simulators.md does what it says."""

import re
import subprocess
import sys

import pytest
from tests.how_to import blocks_of, wait_until_printed
from tests.places import EXAMPLES, HOW_TO, PATH, ROOT

PAGE = (HOW_TO / "simulators.md").read_text(encoding="utf-8")
MUJOCO = (EXAMPLES / "mujoco_robot" / "mujoco_robot.py").read_text(encoding="utf-8")


@pytest.fixture(autouse=True)
def _in_a_clone(monkeypatch):
    monkeypatch.setenv("PATH", PATH)
    monkeypatch.chdir(ROOT)


def test_the_search_words_stand_in_the_first_line():
    title = PAGE.splitlines()[0]
    assert all(
        words in title
        for words in ("MuJoCo TF", "Gymnasium turtlesim", "Simulate a robot without Gazebo")
    )


def test_the_commands_move_the_arm(run):
    start, command = blocks_of(PAGE, "sh")
    program = run("bash", "-c", f"exec {start.strip().removesuffix(' &')}")
    program.wait_for("simulating ")
    publish, echo = command.replace("\\\n", " ").splitlines()
    published = run("bash", "-c", f"exec {publish}")
    assert published.wait() == 0, published.text
    (wanted,) = (text for text in blocks_of(PAGE, "text") if text.startswith("At time "))
    wait_until_printed(wanted, lambda: text_of(run, echo))  # the arm moves


def text_of(run, command):
    program = run("bash", "-c", f"exec {command}")
    assert program.wait() == 0, program.text
    return f"{program.text}\n"


def test_the_program_reaches_the_goals():
    (program, printed), *others = re.findall(
        r"^```python\n(.*?)^```\n\n```text\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL
    )
    assert not others
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program],
        cwd=EXAMPLES / "gym_turtlesim",
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, printed, "")


def test_the_tables_list_the_parameters_and_topics():
    parameters = re.findall(r'declare_parameter\("(\w+)"', MUJOCO)
    assert len(parameters) == 3
    topics = re.findall(r'"/?((?:joint_states|clock|[\w]+/[\w/]+))"', MUJOCO)
    assert len(topics) == 5
    for name in [*parameters, *(f"/{topic}" for topic in topics), "/tf", "/tf_static"]:
        assert f"`{name}`" in PAGE
