import os
import unittest

from ament_index_python.packages import get_package_prefix
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration
from launch_testing import post_shutdown_test
from launch_testing.actions import ReadyToTest
from launch_testing.asserts import assertExitCodes
from launch_testing.util import KeepAliveProc


def generate_test_description():
    program = os.path.join(get_package_prefix("bridge_server"), "lib", "bridge_server", "bridge")
    return LaunchDescription([
        DeclareLaunchArgument("topic"),
        ExecuteProcess(cmd=[program, LaunchConfiguration("topic")], output="screen"),
        KeepAliveProc(),
        ReadyToTest(),
    ])


class TestWhileItRuns(unittest.TestCase):
    def test_topic_is_announced(self, proc_output, proc_info):
        proc_output.assertWaitFor("['/launched']", timeout=120, stream="stdout")
        proc_info.assertWaitForShutdown("bridge", timeout=120)


@post_shutdown_test()
class TestAfterwards(unittest.TestCase):
    def test_it_ended_well(self, proc_info):
        assertExitCodes(proc_info)
