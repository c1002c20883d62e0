"""Runs of one test of ``colcon test``: the result is always in a JUnit file."""

import sys
from xml.etree import ElementTree as ET

import pytest

from turtlewire_colcon.run_test import main


def status_of(tmp_path, kind, words, *flags, timeout="60"):
    options = ["--kind", kind, "--name", "pkg.a", "--timeout", timeout, *flags]
    options += ["--result", str(tmp_path / "results/a.xunit.xml")]
    return main([*options, "--folder", str(tmp_path / "build"), "--", *words])


def result_of(tmp_path, kind, words, timeout="60"):
    """Exit status, and the message of the failure in the result file, or what it is else."""
    status = status_of(tmp_path, kind, words, timeout=timeout)
    case = ET.parse(tmp_path / "results/a.xunit.xml").find(".//testcase")
    failure, skipped = case.find("failure"), case.find("skipped")
    failure = case.find("error") if failure is None else failure
    if skipped is not None:
        return status, f"skipped: {skipped.get('message')}"
    return status, "passed" if failure is None else failure.get("message").splitlines()[0]


@pytest.fixture(autouse=True)
def in_tmp_path(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("", (0, "passed")),
        ("import sys; sys.exit(3)", (3, "exit status 3")),
        ("import os, sys; sys.exit(os.path.basename(os.getcwd()) != 'build')", (0, "passed")),
    ],
)
def test_a_command(tmp_path, source, expected):
    assert result_of(tmp_path, "command", [sys.executable, "-c", source]) == expected


def test_a_command_without_end_is_stopped(tmp_path):
    source = "import threading; threading.Event().wait()"
    expected = (1, "no end after 0.5 s")
    assert result_of(tmp_path, "command", [sys.executable, "-c", source], "0.5") == expected


def test_pytest_writes_the_result_itself(tmp_path):
    (tmp_path / "test_it.py").write_text("def test_it():\n    assert 1 == 2\n")
    status, message = result_of(tmp_path, "pytest", [str(tmp_path / "test_it.py")])
    assert (status, message) == (1, "assert 1 == 2")


def test_no_selected_test_is_no_failure(tmp_path):
    (tmp_path / "test_it.py").write_text("def test_it():\n    assert 1 == 2\n")
    words = [str(tmp_path / "test_it.py"), "-k", "another"]
    assert status_of(tmp_path, "pytest", words) == 0


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("def helper(): pass\n", (5, "there is no test in it: ")),
        (None, (4, "pytest ended with 4: ")),
        ("import nothing_of_this_name\n", (2, "collection failure")),
        ("import pytest\npytest.skip('not here', allow_module_level=True)\n", (0, "skipped: ")),
    ],
)
def test_a_file_without_tests_is_a_failure_of_its_own(tmp_path, text, expected):
    path = tmp_path / "test_it.py"
    if text is not None:
        path.write_text(text)
    status, message = result_of(tmp_path, "pytest", [str(path)])
    assert status == expected[0]
    assert message.startswith(expected[1])


def test_a_test_that_cannot_begin_has_a_result_too(tmp_path):
    status, message = result_of(tmp_path, "pytest", ["--no-such-option"])
    assert (status, message) == (4, "the test ended without a result")


def test_a_launch_test_without_launch_testing_is_skipped(tmp_path, monkeypatch):
    monkeypatch.setattr("turtlewire_colcon.run_test.find_spec", lambda name: None)
    assert result_of(tmp_path, "launch", ["x.py"]) == (
        0,
        "skipped: there is no launch_testing here",
    )


@pytest.mark.parametrize("wanted", [True, False])
def test_a_domain_of_its_own(tmp_path, monkeypatch, wanted):
    monkeypatch.setenv("ROS_DOMAIN_ID", "231")
    monkeypatch.delenv("DISABLE_ROS_ISOLATION", raising=False)
    if not wanted:
        monkeypatch.setenv("DISABLE_ROS_ISOLATION", "")
    source = "import os, sys; sys.exit(int(os.environ['ROS_DOMAIN_ID'] == '231'))"
    command = [sys.executable, "-c", source]
    assert status_of(tmp_path, "command", command, "--isolated") == (0 if wanted else 1)
