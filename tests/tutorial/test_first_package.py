"""The commands of docs/how-to/first_package.md, typed from top to bottom."""

import shlex
import shutil

import pytest
from tests.how_to import blocks
from tests.places import BIN, HOW_TO, LEARNING, ROOT

PAGE = (HOW_TO / "first_package.md").read_text(encoding="utf-8")
BLOCKS = blocks(PAGE)
HAT, LAUNCH = (text for kind, text in BLOCKS if kind == "python")
MAKE, BUILD = (text for kind, text in BLOCKS if kind == "bash")
(DATA_FILES,) = (text for kind, text in BLOCKS if kind == "diff")
SHOWN = [line for kind, text in BLOCKS if kind == "text" for line in text.splitlines()]

pytestmark = [
    pytest.mark.slow,
    pytest.mark.timeout(300),
    pytest.mark.skipif(
        not (BIN / "colcon").exists() or not (BIN.parent / "setup.bash").exists(),
        reason="colcon is not installed: scripts/setup workspace",
    ),
]


@pytest.fixture
def bash(run, tmp_path, workspace):
    """Runs lines in a shell that has sourced `setup.bash`, with its own home folder."""
    tutorial = workspace(LEARNING)
    environment = tutorial | {"HOME": str(tmp_path), "ROS_LOG_DIR": str(tmp_path / "log")}

    def bash(*lines):
        words = ["set -e", f"source {shlex.quote(str(BIN.parent / 'setup.bash'))}", *lines]
        return run("bash", "--norc", "-c", "\n".join(words), environment=environment, cwd=tmp_path)

    return bash


def changed(setup, diff):
    """The text of setup.py after the page's change, whose other lines must be there."""
    lines = setup.splitlines()
    head, added, tail = diff.splitlines()
    place = lines.index(tail[1:])
    assert lines[place - 1] == head[1:]
    return "\n".join([*lines[:place], added[1:], *lines[place:]]) + "\n"


def test_the_page_from_top_to_bottom(bash, tmp_path):
    home = "cd ~/ros2_ws"
    made = bash(*MAKE.splitlines())
    assert made.wait(60) == 0, made.text
    package = tmp_path / "ros2_ws/src/my_turtle"
    assert (package / "my_turtle/hat.py").is_file()
    (package / "my_turtle/hat.py").write_text(HAT)

    early = bash(home, "ros2 run my_turtle hat")
    assert early.wait(60) == 1
    assert "'my_turtle' is in src/my_turtle, but it is not built" in early.text
    build, source = BUILD.splitlines()
    built = bash(home, build, "ros2 run my_turtle hat")
    assert built.wait(120) == 1
    assert "'my_turtle' is built in install, but this shell does not know it" in built.text

    node = bash(home, source, next(line for line in SHOWN if line.startswith("ros2 run my_turtle")))
    node.wait_for("turtle1 has a hat")
    node.signal_group(2)
    assert node.wait(60) == 0, node.text

    (package / "launch").mkdir()
    (package / "launch/hat.launch.py").write_text(LAUNCH)
    launch = next(line for line in SHOWN if line.startswith("ros2 launch"))
    missing = bash(home, source, launch)
    assert missing.wait(60) == 1
    assert "src/my_turtle/launch/hat.launch.py exists, but it is not installed" in missing.text
    setup = package / "setup.py"
    setup.write_text(changed(setup.read_text(), DATA_FILES))
    launched = bash(home, source, build, launch)
    launched.wait_for("turtle1 has a hat")
    echo = bash(home, next(line for line in SHOWN if "tf2_echo" in line))
    echo.wait_for(r"Translation: \[6\.044, 5\.544, 0\.000\]")
    echo.signal_group(2)
    echo.wait(60)
    launched.signal_group(2)
    assert launched.wait(60) == 0, launched.text


def test_rosdep_says_what_the_page_says(bash, tmp_path):
    shutil.copytree(LEARNING, tmp_path / "src/p")
    manifest = tmp_path / "src/p/package.xml"
    manifest.write_text(manifest.read_text().replace("<depend>launch<", "<br><depend>launch<", 1))
    rosdep = bash("rosdep install -i --from-path src -y")
    assert rosdep.wait(60) != 0
    assert "mismatched tag: line" in rosdep.text


def test_rosdep_needs_no_update_and_says_what_it_does_not_know(bash, tmp_path):
    shutil.copytree(LEARNING, tmp_path / "src/p")
    manifest = tmp_path / "src/p/package.xml"
    unknown = "<depend>no_such_key</depend><depend>launch<"
    manifest.write_text(manifest.read_text().replace("<depend>launch<", unknown, 1))
    rosdep = bash("rosdep install -i --from-path src --rosdistro jazzy -y")
    assert rosdep.wait(60) != 0
    assert "Cannot locate rosdep definition for [no_such_key]" in rosdep.text
    skipping = bash(
        "rosdep install -i --from-path src --rosdistro jazzy -y --skip-keys no_such_key"
    )
    assert skipping.wait(60) == 0
    assert skipping.text.splitlines()[0] == "#All required rosdeps installed successfully"


def test_the_page_is_found_from_the_demo_and_the_readme():
    assert "(docs/how-to/first_package.md)" in (ROOT / "README.md").read_text()
    assert "(first_package.md)" in (HOW_TO / "learning_tf2_py.md").read_text()
    assert "how-to/first_package\n" in (ROOT / "docs/index.md").read_text()
