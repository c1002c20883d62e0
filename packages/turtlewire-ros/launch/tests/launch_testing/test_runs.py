"""Launch tests as a user runs them: with pytest and with `launch_test`; the how-to page."""

import asyncio
import os
import shlex
import shutil
import subprocess
import sys
import sysconfig
import venv
from itertools import chain
from pathlib import Path
from types import SimpleNamespace
from xml.etree import ElementTree as ET

import pytest
from tests.how_to import blocks, blocks_of
from tests.places import HOW_TO, PATH

from launch import LaunchDescription, LaunchService
from launch.actions import LogInfo
from launch_pytest.fixture import finalize_launch_service
from launch_pytest.plugin import get_launch_test_fixture_scope
from launch_testing.tools import expect_output

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


WITHOUT_READY_TO_TEST = """
import launch, launch_pytest, pytest

@launch_pytest.fixture
def description():
    return launch.LaunchDescription([launch.actions.ExecuteProcess(cmd=["sleep", "100"])])

@pytest.mark.launch(fixture=description)
def test_it(): pass
"""


def test_a_missing_ready_to_test_is_added(tmp_path):
    (tmp_path / "test_it.py").write_text(WITHOUT_READY_TO_TEST)
    done = run(*PYTEST, "test_it.py", cwd=tmp_path)
    assert done.returncode == 0, done.stdout
    two = "[*[launch_pytest.actions.ReadyToTest()] * 2, launch.actions"
    two = WITHOUT_READY_TO_TEST.replace("[launch.actions", two)
    (tmp_path / "test_it.py").write_text(two)
    done = run(*PYTEST, "test_it.py", cwd=tmp_path)
    assert done.returncode == 1
    assert "containing exactly one ReadyToTest action, found 2" in done.stdout


@pytest.mark.parametrize("strict", [False, True])
def test_expected_lines_and_texts_are_any_iterable(strict):
    assert expect_output("a\nb\n", expected_lines=chain("a", "b"), strict=strict)
    assert not expect_output("a\nb\n", expected_lines=chain("b", "a"), strict=strict)
    assert expect_output("ab", expected_text=chain("a", "b"), strict=strict)
    with pytest.raises(ValueError, match="expected a line"):
        expect_output("a", expected_lines=5)


@pytest.mark.slow
@pytest.mark.skipif(sys.version_info >= (3, 13), reason="pytest 7.4 runs on Python 3.12 at most")
def test_the_pytest_of_ubuntu_24_04_runs_launch_tests(tmp_path):
    """Ubuntu 24.04 has pytest 7.4, and so have the robots with Jazzy."""
    venv.create(tmp_path / "venv", with_pip=True)
    python = tmp_path / "venv" / "bin" / "python"
    assert run(python, "-m", "pip", "install", "pytest==7.4.4").returncode == 0
    # All else comes from this environment, after the venv's own packages.
    here = sysconfig.get_path("purelib")
    there = run(python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))").stdout
    more = f"import site; site.addsitedir({here!r})\n"
    Path(there.strip(), "zz_this_environment.pth").write_text(more)
    names = ("sample_classes.py", "sample_functions.py", "sample_failing.py")
    for name in names:
        shutil.copy(SAMPLES / name, tmp_path)
    words = ("-m", "pytest", "-q", "-W", "error", "-p", "no:cacheprovider")
    done = run(python, *words, *names, "--launch-args", "who:=you", cwd=tmp_path)
    assert "FAILED sample_failing.py::sample_failing" in done.stdout, done.stdout
    assert "1 failed, 12 passed" in done.stdout
    version = run(python, "-m", "pytest", "--version", cwd=tmp_path)
    assert version.stdout.strip() == "pytest 7.4.4"


def test_failures_with_launch_test(tmp_path):
    report, older = tmp_path / "report.xml", tmp_path / "older.xml"
    older.write_text("older")
    report.hardlink_to(older)
    sample = SAMPLES / "sample_failing.py"
    done = run(*LAUNCH_TEST, sample, "--junit-xml", report, "--package-name", "mine", cwd=tmp_path)
    assert done.returncode == 1, done.stdout
    assert older.read_text() == "older"  # it was not emptied before the new one was complete
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
        (["robot.urdf"], 2, "error: Test file 'robot.urdf' is not a Python file: .py is missing"),
        (
            ["without.py", "--junit-xml", "no_folder/report.xml"],
            2,
            "error: argument --junit-xml: cannot write 'no_folder/report.xml'",
        ),
        (["without.py", "--junit-xml", "."], 2, "argument --junit-xml: cannot write '.'"),
        ([SAMPLES / "sample_classes.py", "-s"], 0, "'who':\n        who speaks\n        (default"),
        (
            [SAMPLES / "sample_failing.py", "who=you"],
            2,
            "malformed launch argument 'who=you', expected format '<name>:=<value>'",
        ),
    ],
)
def test_the_command_line(tmp_path, words, status, says):
    for name in ("empty.py", "robot.urdf"):
        (tmp_path / name).touch()
    (tmp_path / "without.py").write_text(WITHOUT)
    done = run(*LAUNCH_TEST, *words, cwd=tmp_path)
    assert done.returncode == status, done.stdout
    assert says in done.stdout


@pytest.mark.skipif(sys.platform != "linux", reason="Windows deletes no folder that is in use")
def test_a_current_folder_that_was_deleted_is_an_error(tmp_path):
    gone = tmp_path / "gone"
    gone.mkdir()
    words = (*LAUNCH_TEST, SAMPLES / "sample_classes.py")
    done = run("bash", "-c", 'rmdir "$PWD" && "$@"', "bash", *words, cwd=gone)
    assert done.returncode == 2
    assert done.stdout.endswith("launch_test: error: the current folder was deleted\n")
    assert "Traceback" not in done.stdout


@pytest.mark.skipif(sys.platform != "linux", reason="needs /dev/full")
def test_a_report_that_cannot_be_written_is_an_error():
    words = (SAMPLES / "sample_classes.py", "who:=you", "--junit-xml", "/dev/full")
    done = run(*LAUNCH_TEST, *words)
    assert done.returncode == 2
    says = "argument --junit-xml: cannot write '/dev/full': No space left on device"
    assert done.stdout.endswith(f"launch_test: error: {says}\n")
    # A process of the launch that is interrupted while it starts prints one, behind its name.
    assert "\nTraceback" not in done.stdout


@pytest.mark.skipif(sys.platform != "linux", reason="needs /dev/full")
def test_a_full_disk_is_named():
    command = shlex.join([*LAUNCH_TEST, str(SAMPLES / "sample_classes.py")])
    done = run("bash", "-c", f"{command} 2>&1 >/dev/full")
    assert done.returncode == 1
    assert done.stdout.endswith(": write error: No space left on device\n")


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


@pytest.mark.parametrize("parameters", ["module_path, parent", "path, parent"])
def test_a_plugin_collects_launch_tests_in_its_own_way(tmp_path, parameters):
    file = parameters.partition(",")[0]
    (tmp_path / "conftest.py").write_text(
        "import pytest\n\nclass Own(pytest.File):\n"
        "    def collect(self):\n        print('COLLECTED', self.path.name)\n        return []\n\n"
        f"def pytest_launch_collect_makemodule({parameters}, entrypoint):\n"
        f"    return Own.from_parent(parent, path={file})\n"
    )
    (tmp_path / "test_unready.py").write_text(WITHOUT)
    done = run(*PYTEST, "-s", cwd=tmp_path)
    assert "COLLECTED test_unready.py" in done.stdout, done.stdout


def test_the_end_of_a_launch_that_a_program_runs():
    loop = asyncio.new_event_loop()
    service = LaunchService()
    service.include_launch_description(LaunchDescription([LogInfo(msg="runs")]))
    task = loop.create_task(service.run_async(shutdown_when_idle=False))
    finalize_launch_service(service, task=task)
    assert task.result() == 0
    loop.close()


def test_the_scope_of_a_launch_fixture():
    decorated = SimpleNamespace(_launch_pytest=SimpleNamespace(scope="module"))
    assert get_launch_test_fixture_scope(decorated) == "module"
    assert get_launch_test_fixture_scope(print) is None


# The how-to page about launch tests, run.

PAGE = HOW_TO / "test_a_node.md"


@pytest.mark.slow
def test_the_page_does_what_it_says(tmp_path):
    text = PAGE.read_text()
    assert [kind for kind, _ in blocks(text)] == ["python", "sh", "sh", "python", "sh"]
    names = ("test_talker.py", "test_talker_functions.py")
    assert [f"`{name}`" in text for name in names] == [True, True]
    programs = blocks_of(text, "python")
    for name, code in zip(names, programs, strict=True):
        (tmp_path / name).write_text(code)
    path = PATH
    for line in "".join(blocks_of(text, "sh")).splitlines():
        done = subprocess.run(
            shlex.split(line),
            cwd=tmp_path,
            env={**os.environ, "PATH": path},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=840,
            check=False,
        )
        assert done.returncode == 0, (line, done.stdout)
    assert 'tests="3"' in (tmp_path / "report.xml").read_text()
