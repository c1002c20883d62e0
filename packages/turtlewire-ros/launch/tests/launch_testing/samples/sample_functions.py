"""Tests that pass with launch_pytest: functions, coroutines and generators, in the right order."""

import sys

import pytest

import launch_pytest
import launch_testing.util
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch_pytest.tools import process

ORDER = []


@pytest.fixture
def speaker():
    return ExecuteProcess(cmd=[sys.executable, "-c", "print('hello')"], cached_output=True)


@launch_pytest.fixture
def description(speaker):
    return LaunchDescription([speaker, launch_pytest.actions.ReadyToTest()])


@pytest.mark.launch(fixture=description)
def test_generator(speaker, launch_context):
    def says_hello(text):
        assert text.splitlines() == ["hello"]

    process.assert_output_sync(launch_context, speaker, says_hello, timeout=60)
    assert not process.wait_for_output_sync(launch_context, speaker, "".__eq__, timeout=0.01)
    with pytest.raises(AssertionError, match="not accepted: 'hello"):
        process.assert_output_sync(launch_context, speaker, "".__eq__, timeout=0.01)
    assert process.wait_for_exit_sync(launch_context, speaker, timeout=60)
    yield
    assert speaker.return_code == 0


@pytest.mark.launch(fixture=description)
async def test_coroutine(speaker, launch_context):
    assert await process.wait_for_start(launch_context, speaker, timeout=60)
    assert await process.wait_for_exit(launch_context, speaker, timeout=60)


@pytest.mark.launch(fixture=description, shutdown=True)
def test_after_shutdown(speaker):
    assert speaker.return_code is not None


@launch_pytest.fixture(scope="module")
def shared():
    keep_alive = launch_testing.util.KeepAliveProc()
    return LaunchDescription([keep_alive, launch_pytest.actions.ReadyToTest()])


@pytest.mark.launch(fixture=shared, shutdown=True)
def test_last(launch_service):
    assert launch_service.event_loop is None
    assert ORDER[:4] == ["one", "two", "three", "four"]


@pytest.mark.launch(fixture=shared)
async def test_one():
    ORDER.append("one")


@pytest.mark.launch(fixture=shared)
def test_two(launch_service):
    assert launch_service.event_loop is not None
    ORDER.append("two")
    yield
    ORDER.append("two ends")
    assert launch_service.event_loop is None


@pytest.mark.launch(fixture=shared)
async def test_three(launch_service):
    ORDER.append("three")
    yield
    ORDER.append("three ends")
    assert launch_service.event_loop is None


@pytest.mark.launch(fixture=shared)
def test_four():
    ORDER.append("four")


def test_plain():
    """A plain test among them is left alone."""
