"""Tests as actions of a launch."""

import sys

import pytest

from launch import LaunchDescription, LaunchService
from launch.actions import ExecuteProcess, LogInfo, OpaqueCoroutine
from launch_testing.legacy import LaunchTestService
from launch_testing.legacy.output import (
    create_output_lines_filter,
    create_output_lines_test,
    create_output_regex_test,
    create_output_test_from_file,
    get_default_filtered_patterns,
    get_default_filtered_prefixes,
    get_rmw_output_filter,
)

WAITS = "import threading; print('up', flush=True); threading.Event().wait()"


def program(code):
    return ExecuteProcess(cmd=[sys.executable, "-c", code])


def run(tests, description):
    service = LaunchService()
    service.include_launch_description(description)
    return tests.run(service)


@pytest.fixture
def tests():
    return LaunchTestService()


@pytest.fixture
def description(tests):
    """A launch with a process that runs until the end."""
    description = LaunchDescription()
    fixture = program(WAITS)
    assert tests.add_fixture_action(description, fixture) is fixture
    return description


@pytest.mark.parametrize(("code", "status"), [("pass", 0), ("raise SystemExit(3)", 3)])
def test_a_process_is_a_test(tests, description, code, status):
    tests.add_test_action(description, program("pass"))
    tests.add_test_action(description, program(code))
    assert run(tests, description) == status


@pytest.mark.parametrize(("error", "status"), [(None, 0), (ValueError("x"), 1)])
def test_a_coroutine_is_a_test(tests, description, error, status):
    async def check(_context):
        if error is not None:
            raise error

    tests.add_test_action(description, OpaqueCoroutine(coroutine=check))
    assert run(tests, description) == status


def test_another_action_is_no_test(tests, description):
    with pytest.raises(TypeError, match="a test is a process or an OpaqueCoroutine"):
        tests.add_test_action(description, LogInfo(msg=""))


@pytest.mark.parametrize(("allowed", "status"), [([0], 7), (False, 7), ([7], 0), (True, 0)])
def test_a_fixture_that_ends_too_early(tests, allowed, status):
    description = LaunchDescription()
    dies = program("raise SystemExit(7)")
    tests.add_fixture_action(description, dies, exit_allowed=allowed)
    # With a fixture that may end, the test ends the launch; else it is the fixture's end.
    tests.add_test_action(description, program("pass" if status == 0 else WAITS))
    assert (run(tests, description) == 0) is (status == 0)


@pytest.mark.parametrize(
    ("expected", "effect", "status"), [("up", "shutdown", 0), ("up", None, 0), ("never", None, 2)]
)
def test_the_output_of_a_process_is_a_test(tests, expected, effect, status):
    description = LaunchDescription()
    writes = program("print('rc=0', flush=True); print('up', flush=True); raise SystemExit(2)")
    description.add_action(writes)
    tests.add_output_test(
        description,
        writes,
        create_output_lines_test([expected]),
        output_filter=create_output_lines_filter(),
        side_effect=effect,
    )
    with pytest.raises(ValueError, match="give it another test_suffix"):
        tests.add_output_test(description, writes, bool)
    tests.add_output_test(description, writes, create_output_regex_test(["^u"]), test_suffix="re")
    assert (run(tests, description) == 0) is (status == 0)


def test_filters_and_tests_of_output(tmp_path):
    assert get_default_filtered_prefixes() == ["pid", "rc"]
    assert get_default_filtered_patterns() == []
    assert get_rmw_output_filter("rmw_nobody", "prefixes") == []
    text = "pid 1\na\nbc\nd\n"
    filtered = create_output_lines_filter(filtered_patterns=["^b"])
    assert filtered(text) == "a\nd\n"
    assert create_output_lines_filter([], [], "rmw_nobody")(text) == text
    assert create_output_lines_test(["a", "bc"])(text)
    assert not create_output_lines_test(["a", "d"])(text)
    assert create_output_lines_test([])("")
    assert create_output_regex_test(["^b", "d$"])(text)
    assert not create_output_regex_test(["^b", "^c"])(text)
    (tmp_path / "x.txt").write_text("a\nbc\n")
    (tmp_path / "y.regex").write_text("^b.\n")
    assert create_output_test_from_file(f"{tmp_path}/x")(text)
    assert create_output_test_from_file(f"{tmp_path}/y")(text)
    with pytest.raises(RuntimeError, match="could not find output check file"):
        create_output_test_from_file(f"{tmp_path}/z")
