"""Launch tests as a user runs them: with pytest and with `launch_test`."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

SAMPLES = Path(__file__).parent / "samples"
LAUNCH_TEST = (sys.executable, "-m", "launch_testing.launch_test")
PYTEST = (sys.executable, "-m", "pytest", "-q", "-W", "error", "-p", "no:cacheprovider")


def run(*command, cwd=None):
    return subprocess.run(
        [str(word) for word in command],
        cwd=cwd,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=840,
        check=False,
    )


def outcomes(report):
    """Each test with what came of it, in order."""
    return [
        (case.get("name"), case[0].tag if len(case) else "passed")
        for case in ET.parse(report).getroot().iter("testcase")
    ]


def test_passing_tests_with_pytest(tmp_path):
    report = tmp_path / "report.xml"
    files = ("sample_classes.py", "sample_functions.py")
    for name in files:
        shutil.copy(SAMPLES / name, tmp_path)
    done = run(*PYTEST, *files, "--launch-args", "who:=you", "--junit-xml", report, cwd=tmp_path)
    assert done.returncode == 0, done.stdout
    assert [name for name, _ in outcomes(report)] == [
        "sample_classes",
        "test_generator",
        "test_coroutine",
        "test_after_shutdown",
        "test_one",
        "test_two",
        "test_three",
        "test_four",
        "test_last",
        "test_two[shutdown_test]",
        "test_three[shutdown_test]",
        "test_plain",
    ]


def test_failures_with_launch_test(tmp_path):
    report = tmp_path / "report.xml"
    sample = SAMPLES / "sample_failing.py"
    done = run(*LAUNCH_TEST, sample, "--junit-xml", report, "--package-name", "mine", cwd=tmp_path)
    assert done.returncode == 1, done.stdout
    assert "Waiting for output timed out: 'nothing' on stderr" in done.stdout
    assert "Proc process-1 exited with code 5" in done.stdout
    assert "Processes under test stopped before tests completed" in done.stdout
    assert "##### 'process-2' output #####\nI fail\n" in done.stdout
    assert done.stdout.endswith("FAILED: Launch stopped before the active tests finished.\n")
    assert outcomes(report) == [
        ("test_fine", "passed"),
        ("test_text", "failure"),
        ("test_exit_code", "failure"),
        *((name, "failure") for name in ("test_fine", "test_text", "test_exit_code")),
    ]
    names = [suite.get("name") for suite in ET.parse(report).getroot()]
    assert names == [f"mine.sample_failing.launch_tests[lives={lives}]" for lives in (True, False)]


WITHOUT = """
import pytest
from launch import LaunchDescription

@pytest.mark.launch_test
def generate_test_description():
    return LaunchDescription()
"""


DOMAIN = """
import os
import unittest
import launch_testing.actions
import launch_testing.util
from launch import LaunchDescription

def generate_test_description():
    ready = launch_testing.actions.ReadyToTest()
    return LaunchDescription([launch_testing.util.KeepAliveProc(), ready])

class TestDomain(unittest.TestCase):
    def test_domain(self):
        assert int(os.environ["ROS_DOMAIN_ID"]) > 0
"""


@pytest.mark.parametrize(
    ("words", "status", "says"),
    [
        (["none.py"], 2, "error: Test file 'none.py' does not exist"),
        (["empty.py"], 2, "Test file 'empty.py' is missing generate_test_description function"),
        (
            ["without.py"],
            2,
            "must return a LaunchDescription that contains a launch_testing.actions.",
        ),
        ([SAMPLES / "sample_classes.py", "-s"], 0, "'who':\n        who speaks\n        (default"),
        (
            [SAMPLES / "sample_failing.py", "who=you"],
            2,
            "malformed launch argument 'who=you', expected format '<name>:=<value>'",
        ),
    ],
)
def test_the_command_line(tmp_path, words, status, says):
    (tmp_path / "empty.py").touch()
    (tmp_path / "without.py").write_text(WITHOUT)
    done = run(*LAUNCH_TEST, *words, cwd=tmp_path)
    assert done.returncode == status, done.stdout
    assert says in done.stdout


def test_ros2_test_chooses_a_domain(tmp_path, monkeypatch):
    (tmp_path / "test_domain.py").write_text(DOMAIN)
    monkeypatch.delenv("ROS_DOMAIN_ID")
    program = "import sys; from ros2cli.main import main; sys.exit(main())"
    ros2 = (sys.executable, "-c", program, "test", "test_domain.py")
    done = run(*ros2, cwd=tmp_path)
    assert done.returncode == 0, done.stdout
    assert "Running with ROS_DOMAIN_ID " in done.stdout
    done = run(*ros2, "--disable-isolation", cwd=tmp_path)
    assert done.returncode == 1, done.stdout
    assert "KeyError: 'ROS_DOMAIN_ID'" in done.stdout


def test_plain_tests_do_not_wait_for_launch(tmp_path):
    (tmp_path / "test_plain.py").write_text(
        "import sys\nimport pytest\n\ndef test_nothing_was_imported():\n"
        "    assert 'launch' not in sys.modules\n"
        "\ndef test_event_loop(request):\n"
        "    with pytest.raises(pytest.FixtureLookupError):\n"
        "        request.getfixturevalue('event_loop')\n"
    )
    done = run(*PYTEST, "test_plain.py", "--strict-markers", cwd=tmp_path)
    assert done.returncode == 0, done.stdout
    assert "2 passed" in done.stdout


def test_wrong_marks_are_reported(tmp_path):
    (tmp_path / "test_wrong.py").write_text(
        "import pytest\n\n@pytest.mark.launch(fixture=print)\ndef test_it():\n    pass\n"
    )
    (tmp_path / "test_unready.py").write_text(WITHOUT)
    done = run(*PYTEST, "--continue-on-collection-errors", cwd=tmp_path)
    assert "test_it: @pytest.mark.launch needs fixture=…" in done.stdout
    assert "RuntimeError: generate_test_description must return a LaunchD" in done.stdout
    assert "1 failed, 1 error" in done.stdout
