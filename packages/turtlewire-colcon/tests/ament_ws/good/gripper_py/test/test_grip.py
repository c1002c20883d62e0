import launch_pytest
import pytest
from launch import LaunchDescription
from launch_pytest.tools import process
from launch_ros.actions import Node


@pytest.fixture
def grip():
    return Node(package="gripper_py", executable="grip", output="screen", cached_output=True)


@launch_pytest.fixture
def description(grip):
    return LaunchDescription([grip, launch_pytest.actions.ReadyToTest()])


@pytest.mark.launch(fixture=description)
async def test_it_grips(grip, launch_context):
    await process.wait_for_output(launch_context, grip, lambda text: "gripped" in text, timeout=60)
    await process.wait_for_exit(launch_context, grip, timeout=60)
    assert grip.return_code == 0
