"""Ctrl-C and other signals, at `ros2 launch` in a separate process or terminal."""

import os
import signal

import pytest
from tests.places import ROS2

HEAD = """
import sys
from launch import LaunchDescription
from launch.actions import ExecuteProcess, LogInfo, TimerAction

def child(code, **options):
    command = [sys.executable, "-c", code]
    return ExecuteProcess(cmd=command, name="child", output="screen", **options)

WAITS = '''
import signal
try:
    print("ready", flush=True)
    signal.pause()
except KeyboardInterrupt:
    print("bye")
'''
IGNORES = '''
import signal
signal.signal(signal.SIGINT, signal.SIG_IGN)
print("ready", flush=True)
signal.pause()
'''

def generate_launch_description():
    return LaunchDescription([
"""
TWO_CHILDREN = HEAD + "child(WAITS), child(WAITS)])"
STUBBORN_CHILD = HEAD + "child(IGNORES, sigterm_timeout=0.3)])"


RECEIVES_IN_A_THREAD = """
import signal, threading
from launch import LaunchDescription
from launch.actions import ExecuteProcess, OpaqueFunction

def interrupt(context):
    receive = lambda: signal.pthread_kill(threading.get_ident(), signal.SIGINT)
    threading.Timer(0.5, receive).start()  # by then, the loop sleeps

def generate_launch_description():
    sleep = ExecuteProcess(cmd=["sleep", "100"])
    return LaunchDescription([sleep, OpaqueFunction(function=interrupt)])
"""


def test_ctrl_c_ends_a_launch_when_another_thread_receives_it(ros2_launch):
    launch = ros2_launch(RECEIVES_IN_A_THREAD)
    assert launch.wait() == 0
    assert "user interrupted with ctrl-c" in launch.text


def test_ctrl_c_in_a_terminal_reaches_the_children_by_itself(ros2_launch):
    launch = ros2_launch(TWO_CHILDREN, terminal=True)
    launch.wait_for(r"\[child-\d\] ready", count=2)
    launch.type("\x03")
    assert launch.wait() == 0
    assert launch.text.count("] bye") == launch.text.count("process has finished cleanly") == 2
    assert "sending signal" not in launch.text
    assert (
        "\x1b[33mWARNING\x1b[0m] [launch]: user interrupted with ctrl-c (SIGINT)" in launch.text
    )  # yellow, as it is a terminal
    assert launch.survivors() == []


@pytest.mark.parametrize("whom", ["launch alone", "the process group"])
def test_ctrl_c_without_a_terminal(ros2_launch, whom):
    launch = ros2_launch(TWO_CHILDREN)
    launch.wait_for(r"\[child-\d\] ready", count=2)
    if whom == "launch alone":
        os.kill(launch.process.pid, signal.SIGINT)
    else:
        launch.signal_group(signal.SIGINT)
    assert launch.wait() == 0
    if whom == "launch alone":  # at two SIGINT at once a child may say anything
        assert launch.text.count("] bye") == 2
        assert launch.text.count("sending signal 'SIGINT' to process[") == 2
    assert "[WARNING] [launch]: user interrupted with ctrl-c (SIGINT)" in launch.text
    assert launch.survivors() == []


def test_a_second_ctrl_c_is_ignored(ros2_launch):
    launch = ros2_launch(STUBBORN_CHILD, terminal=True)
    launch.wait_for(r"\] ready")
    launch.type("\x03")
    launch.wait_for(r"user interrupted with ctrl-c \(SIGINT\)$")
    launch.type("\x03")
    launch.wait_for(r"user interrupted with ctrl-c \(SIGINT\) again, ignoring\.\.\.$")
    assert launch.wait() == 0
    assert (
        "failed to terminate '0.3' seconds after receiving 'SIGINT', escalating to 'SIGTERM'"
        in launch.text
    )
    assert "process has died [pid" in launch.text
    assert launch.survivors() == []


def test_a_hang_up_stops_the_children_too(ros2_launch):
    launch = ros2_launch(TWO_CHILDREN)
    launch.wait_for(r"\[child-\d\] ready", count=2)
    os.kill(launch.process.pid, signal.SIGHUP)
    assert launch.wait() == 1
    assert "[ERROR] [launch]: the terminal was closed (SIGHUP), terminating..." in launch.text
    assert launch.text.count("] bye") == 2
    assert launch.survivors() == []


def test_nohup_is_respected(ros2_launch):
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        launch = ros2_launch(TWO_CHILDREN)
    finally:
        signal.signal(signal.SIGHUP, before)
    launch.wait_for(r"\[child-\d\] ready", count=2)
    os.kill(launch.process.pid, signal.SIGHUP)
    os.kill(launch.process.pid, signal.SIGINT)
    assert launch.wait() == 0
    assert "SIGHUP" not in launch.text


@pytest.mark.parametrize("signum", [signal.SIGTERM, signal.SIGQUIT])
def test_sigterm_stops_the_children_too(ros2_launch, signum):
    launch = ros2_launch(TWO_CHILDREN)
    launch.wait_for(r"\[child-\d\] ready", count=2)
    os.kill(launch.process.pid, signum)
    assert launch.wait() == 1
    assert (
        rf"[ERROR] [launch]: user interrupted with ctrl-\ ({signum.name}), terminating..."
        in launch.text
    )
    assert launch.text.count("] bye") == 2
    assert launch.survivors() == []


def test_not_even_sigkill_leaves_children(ros2_launch):
    launch = ros2_launch(TWO_CHILDREN)
    launch.wait_for(r"\[child-\d\] ready", count=2)
    os.kill(launch.process.pid, signal.SIGKILL)
    assert launch.wait() == -signal.SIGKILL
    launch.wait_for_survivors()


@pytest.mark.parametrize("moment", ["All log files", "process started"])
def test_ctrl_c_while_starting(ros2_launch, moment):
    launch = ros2_launch(HEAD + "*(child(WAITS) for _ in range(8))])")
    launch.wait_for(moment)
    os.kill(launch.process.pid, signal.SIGINT)
    assert launch.wait() == 0
    assert launch.text.count("process started with pid") == launch.text.count("process has ")
    assert launch.survivors() == []


def test_ctrl_c_before_a_timer_has_started_anything(ros2_launch):
    launch = ros2_launch(
        HEAD + "TimerAction(period=100.0, actions=[child(WAITS)]), LogInfo(msg='waiting')])"
    )
    launch.wait_for("waiting")
    os.kill(launch.process.pid, signal.SIGINT)
    assert launch.wait() == 0
    assert "process started" not in launch.text


def test_insisting_ends_a_launch_file_that_hangs(ros2_launch):
    launch = ros2_launch(
        "import time\nwhile True:\n    print('hanging', flush=True)\n    time.sleep(0.05)\n",
        terminal=True,
    )
    for _ in range(3):
        # After two more lines the process has seen the signal before; two at once count as one.
        launch.wait_for("hanging", count=launch.text.count("hanging") + 2)
        launch.type("\x03")
    assert launch.wait() == 2
    assert "Traceback" not in launch.text


def test_a_reader_that_goes_away_ends_the_launch(run, tmp_path):
    (tmp_path / "test.launch.py").write_text(HEAD + "child('while True: print(1)')])")
    shell = run(
        "bash",
        "-c",
        f"set -o pipefail; {ROS2} launch ./test.launch.py 2>&1 | head -n 5",
        cwd=tmp_path,
    )
    assert shell.wait() == 141
    assert len(shell.lines) == 5
    assert "Error" not in shell.text
    shell.wait_for_survivors()


def test_a_full_disk_ends_the_launch_with_one_line(run, tmp_path):
    (tmp_path / "test.launch.py").write_text(HEAD + "child(WAITS)])")
    shell = run("bash", "-c", f"exec {ROS2} launch ./test.launch.py >/dev/full", cwd=tmp_path)
    assert shell.wait() == 1
    assert shell.text == "ros2: write error: No space left on device"
    shell.wait_for_survivors()


def test_keys_reach_the_process_that_asks_for_a_terminal(ros2_launch):
    reads = 'child(\'print("ready"); print("got", input())\', emulate_tty=True)'
    launch = ros2_launch(HEAD + f"child(WAITS), {reads}])", terminal=True)
    launch.wait_for(r"\] ready", count=2)
    launch.type("hello\n")
    launch.wait_for(r"\] got hello")
    launch.type("\x03")
    assert launch.wait() == 0
