"""Tests that pass: parameters, injected objects, marks, processes of single tests."""

import sys
import unittest

import pytest

import launch_testing
import launch_testing.actions
import launch_testing.asserts
import launch_testing.markers
import launch_testing.tools
import launch_testing.util
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration

SPEAK = "import sys; print('a\\nb ' + sys.argv[1]); print('\\033[31moops\\033[0m', file=sys.stderr)"
ATTEMPTS = []


@pytest.mark.launch_test
@launch_testing.markers.keep_alive
@launch_testing.parametrize("word", ["one", "two"])
def generate_test_description(word):
    speaker = ExecuteProcess(
        cmd=[sys.executable, "-c", SPEAK, word, LaunchConfiguration("who")], name="speaker"
    )
    return LaunchDescription(
        [
            DeclareLaunchArgument("who", default_value="me", description="who speaks"),
            speaker,
            launch_testing.actions.ReadyToTest(),
        ]
    ), {"speaker": speaker}


class TestWhileItRuns(unittest.TestCase):
    @classmethod
    def setUpClass(cls, proc_info, speaker):
        proc_info.assertWaitForShutdown(process=speaker, timeout=60)

    def test_streams(self, proc_output, speaker, word):
        proc_output.assertWaitFor(f"b {word}", speaker, stream="stdout", timeout=60)
        proc_output.assertWaitFor("oops", process="speaker", timeout=60)
        assert not proc_output.waitFor("nothing", process=speaker, timeout=0.01)
        with pytest.raises(AssertionError, match=r"timed out: 'none' on stderr.*\n.*oops"):
            proc_output.assertWaitFor("none", process=speaker, timeout=0.01)
        with pytest.raises(AssertionError, match=r"Did not find any processes .* 'nobody'"):
            proc_output.assertWaitFor("none", process="nobody", timeout=0.01)

    def test_attributes(self):
        assert self.test_args == {"who": "you"}
        self.proc_info.assertWaitForStartup(process="speaker", cmd_args="you", timeout=60)

    @launch_testing.markers.retry_on_failure(times=3)
    def test_retried(self):
        ATTEMPTS.append(1)
        assert len(ATTEMPTS) % 2 == 0

    def test_a_process_of_its_own(self, launch_service, proc_info, proc_output):
        action = launch_testing.util.KeepAliveProc()
        with launch_testing.tools.launch_process(
            launch_service, action, proc_info, proc_output
        ) as process:
            assert process.running
            assert process.exit_code is None
        assert process.terminated
        assert process.exit_code is not None


@launch_testing.post_shutdown_test()
class TestAfterwards(unittest.TestCase):
    def test_exit_codes(self, proc_info, speaker):
        launch_testing.asserts.assertExitCodes(proc_info, process=speaker)
        launch_testing.asserts.assertExitCodes(proc_info, [0, 1, -2])

    def test_order(self, proc_output, speaker, word):
        with launch_testing.asserts.assertSequentialStdout(proc_output, speaker) as output:
            output.assertInStdout("a")
            output.assertInStdout(word)
            with pytest.raises(AssertionError, match="'a' not found"):
                output.assertInStdout("a")
        launch_testing.asserts.assertInStdout(proc_output, ["a", f"b {word}"], speaker)
        launch_testing.asserts.assertInStderr(proc_output, "oops", speaker)
        with pytest.raises(
            launch_testing.util.NoMatchingProcessException, match=r"(?s)Procs: .*speaker"
        ):
            launch_testing.asserts.assertInStdout(proc_output, "a", "nobody")
