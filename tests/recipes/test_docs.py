"""docs/how-to/simulators.md, training_data.md and rerun.md do what they say."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from tests.how_to import blocks_of, wait_until_printed
from tests.places import EXAMPLES, HOW_TO, PATH

SIMULATORS, TRAINING, RERUN = (
    (HOW_TO / f"{name}.md").read_text(encoding="utf-8")
    for name in ("simulators", "training_data", "rerun")
)
MUJOCO = (EXAMPLES / "mujoco_robot" / "mujoco_robot.py").read_text(encoding="utf-8")


@pytest.fixture(autouse=True)
def _in_a_clone(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", PATH)
    (tmp_path / "examples").symlink_to(EXAMPLES, target_is_directory=True)
    monkeypatch.chdir(tmp_path)


def shell(commands):
    done = subprocess.run(
        ["bash", "-ec", commands], capture_output=True, text=True, check=False, timeout=300
    )
    assert done.returncode == 0, done.stderr
    return done


def printed_by(program, folder=None):
    """What a Python program of a page prints; it warns of nothing."""
    command = [sys.executable, "-W", "error", "-c", program]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


@pytest.mark.parametrize(
    ("page", "words"),
    [
        (SIMULATORS, ["MuJoCo TF", "Gymnasium turtlesim", "Simulate a robot without Gazebo"]),
        (TRAINING, ["Rosbag to Parquet", "rosbag to LeRobot dataset"]),
        (RERUN, ["ROS 2 Rerun"]),
    ],
)
def test_the_search_words_stand_in_the_first_line(page, words):
    title = page.splitlines()[0]
    assert all(each in title for each in words)


@pytest.mark.slow
def test_the_commands_move_the_arm(run):
    start, command = blocks_of(SIMULATORS, "sh")
    program = run("bash", "-c", f"exec {start.strip().removesuffix(' &')}")
    program.wait_for("simulating ")
    publish, echo = command.replace("\\\n", " ").splitlines()
    published = run("bash", "-c", f"exec {publish}")
    assert published.wait() == 0, published.text
    (wanted,) = (text for text in blocks_of(SIMULATORS, "text") if text.startswith("At time "))
    wait_until_printed(wanted, lambda: text_of(run, echo))  # the arm moves


def text_of(run, command):
    program = run("bash", "-c", f"exec {command}")
    assert program.wait() == 0, program.text
    return f"{program.text}\n"


def test_the_program_reaches_the_goals():
    (program, printed), *others = re.findall(
        r"^```python\n(.*?)^```\n\n```text\n(.*?)^```$", SIMULATORS, re.MULTILINE | re.DOTALL
    )
    assert not others
    assert printed_by(program, EXAMPLES / "gym_turtlesim") == printed


def test_the_tables_list_the_parameters_and_topics():
    parameters = re.findall(r'declare_parameter\("(\w+)"', MUJOCO)
    assert len(parameters) == 3
    topics = re.findall(r'"/?((?:joint_states|clock|[\w]+/[\w/]+))"', MUJOCO)
    assert len(topics) == 5
    for name in [*parameters, *(f"/{topic}" for topic in topics), "/tf", "/tf_static"]:
        assert f"`{name}`" in SIMULATORS


@pytest.mark.slow
def test_the_bags_are_converted_and_read():
    (convert,) = blocks_of(TRAINING, "sh")
    printed, rows = blocks_of(TRAINING, "text")
    assert shell(convert).stdout == printed
    (program,) = blocks_of(TRAINING, "python")
    assert printed_by(program) == rows


def test_the_options_and_modules_of_the_page_exist():
    text = (EXAMPLES / "bag_to_lerobot" / "bag_to_lerobot.py").read_text(encoding="utf-8")
    options = re.findall(r'add\(\s*(?:"-o", )?"(--\w+)"', text)
    assert len(options) == 9
    assert set(options) - {"--output", "--robot"} <= set(re.findall(r"--\w+", TRAINING))
    for name in ("aligned", "images", "dataset"):
        assert f"`{name}.py`" in TRAINING
        assert (EXAMPLES / "bag_to_lerobot" / f"{name}.py").exists()


@pytest.mark.slow
def test_a_bag_becomes_a_file_of_rerun():
    rerun = pytest.importorskip("rerun", reason="the recipe needs Python 3.11")
    (commands,) = blocks_of(RERUN, "sh")
    shell(commands)
    chunks = list(rerun.chunk.RrdReader("arm.rrd").stream())
    assert {"/tf/hand", "/joint_states/elbow"} <= {chunk.entity_path for chunk in chunks}
    live = blocks_of(RERUN, "bash")[1]
    shell(f"{live.strip()} -o live.rrd --seconds 0.5")
    assert Path("live.rrd").stat().st_size > 0


def test_the_table_has_the_types_that_are_logged():
    text = (EXAMPLES / "rerun_log" / "entities.py").read_text(encoding="utf-8")
    types = re.findall(r'"(?:sensor_msgs|tf2_msgs)/msg/(\w+)"', text)
    assert len(set(types)) == 6
    assert all(f"`{name}`" in RERUN for name in types if name != "TFMessage")
