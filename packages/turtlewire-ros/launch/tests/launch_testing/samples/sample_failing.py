"""Tests that fail: a test, the launch itself, and a test after the shutdown."""

import sys
import unittest

import pytest

import launch_testing
import launch_testing.actions
import launch_testing.asserts
from launch import LaunchDescription
from launch.actions import ExecuteProcess

LIVES = """
import signal, sys
signal.signal(2, lambda *_: sys.exit(5))
print("up", flush=True)
signal.pause()
"""


@pytest.mark.launch_test
@launch_testing.ready_to_test_action_timeout(60)
@launch_testing.parametrize("lives", [True, False])
def generate_test_description(lives):
    program = LIVES if lives else "print('I fail'); raise SystemExit(3)"
    process = ExecuteProcess(cmd=[sys.executable, "-c", program], name="process")
    return LaunchDescription([process, launch_testing.actions.ReadyToTest()]), {"process": process}


class TestIt(unittest.TestCase):
    def test_text(self, proc_output, lives):
        if lives:
            proc_output.assertWaitFor("up", stream="stdout", timeout=60)
        proc_output.assertWaitFor("nothing", timeout=0.1 if lives else 60)

    def test_fine(self):
        pass


@launch_testing.post_shutdown_test()
class TestAfterwards(unittest.TestCase):
    def test_exit_code(self, proc_info, process):
        launch_testing.asserts.assertExitCodes(proc_info, [0, 7], process)
