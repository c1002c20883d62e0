"""The order of events and handlers, failures, and the end, also by Ctrl-C and other signals."""

import asyncio
import os
import signal
import threading

import pytest
from tests.places import ROS2

from launch import EventHandler, LaunchDescription, LaunchService
from launch.action import Action
from launch.actions import (
    EmitEvent,
    ExecuteProcess,
    LogInfo,
    OpaqueCoroutine,
    OpaqueFunction,
    RegisterEventHandler,
    Shutdown,
    TimerAction,
)
from launch.event import Event
from launch.event_handlers import OnExecutionComplete, OnProcessStart, OnShutdown


class Ping(Event):
    name = "test.Ping"

    def __init__(self, number=0):
        self.number = number


def is_ping(event):
    return isinstance(event, Ping)


def on_ping(text, **options):
    return RegisterEventHandler(
        EventHandler(matcher=is_ping, entities=[LogInfo(msg=text)], **options)
    )


def test_newest_handlers_come_first(launch):
    assert launch(on_ping("old"), on_ping("new"), EmitEvent(event=Ping())).messages == [
        "new",
        "old",
    ]


def test_a_handler_may_handle_once(launch):
    assert launch(
        on_ping("once", handle_once=True),
        on_ping("each"),
        EmitEvent(event=Ping()),
        EmitEvent(event=Ping()),
    ).messages == ["each", "once", "each"]


def test_a_handler_function_gets_event_and_context(launch):
    def answer(event, context):
        assert context.locals.event is event
        return LogInfo(msg=str(event.number)) if event.number else None

    handler = RegisterEventHandler(EventHandler(matcher=is_ping, entities=answer))
    assert launch(handler, EmitEvent(event=Ping(0)), EmitEvent(event=Ping(7))).messages == ["7"]


def test_events_are_handled_in_the_order_of_their_emission(launch):
    def again(event, _context):
        return [
            LogInfo(msg=str(event.number)),
            *([EmitEvent(event=Ping(event.number - 1))] if event.number else []),
        ]

    assert launch(
        RegisterEventHandler(EventHandler(matcher=is_ping, entities=again)),
        EmitEvent(event=Ping(3)),
    ).messages == list("3210")


def test_a_handler_that_fails_ends_the_launch_after_the_other_handlers(launch):
    def fail(_event, _context):
        raise ValueError("boom")

    failing = RegisterEventHandler(EventHandler(matcher=is_ping, entities=fail))
    outcome = launch(on_ping("the other"), failing, EmitEvent(event=Ping()))
    assert (outcome.status, outcome.error, outcome.messages) == (1, "boom", ["the other"])


def test_entities_after_a_failure_are_not_visited(launch):
    def fail(_context):
        raise ValueError("boom")

    process = ExecuteProcess(cmd=["sleep", "100"])
    outcome = launch(process, OpaqueFunction(function=fail), LogInfo(msg="never"))
    assert (outcome.status, outcome.messages) == (1, [])
    assert process.return_code == -2


def test_an_action_without_execute_has_no_effect(launch):
    outcome = launch(Action(), LogInfo(msg="next"))
    assert (outcome.status, outcome.messages) == (0, ["next"])


def test_completion(launch):
    timer = TimerAction(period=0.01, actions=[])
    log = LogInfo(msg="x")

    def done(event, _context):
        return LogInfo(msg=f"done {type(event.action).__name__}")

    handlers = [
        RegisterEventHandler(OnExecutionComplete(target_action=action, on_completion=done))
        for action in (timer, log)
    ]
    assert launch(*handlers, timer, log).messages == ["x", "done LogInfo", "done TimerAction"]


def test_matchers_must_match_actions():
    with pytest.raises(
        ValueError, match="action_matcher must be a 'ExecuteLocal' instance or a callable"
    ):
        OnProcessStart(target_action=LogInfo(msg="x"), on_start=[])


def test_a_launch_without_anything_ends_at_once(launch):
    outcome = launch()
    assert outcome.status == 0
    assert outcome.lines[0].startswith("[INFO] [launch]: All log files can be found below ")
    assert outcome.lines[1:] == ["[INFO] [launch]: Default logging verbosity is set to INFO"]


def test_debug_shows_tracebacks_and_events(launch):
    def fail(_context):
        raise ValueError("boom")

    text = launch(OpaqueFunction(function=fail), debug=True).text
    assert "[DEBUG] [launch]: Traceback (most recent call last):" in text
    assert (
        "[DEBUG] [launch.launch_context]: emitting event synchronously: "
        "'launch.events.IncludeLaunchDescription'" in text
    )
    assert "[INFO] [launch]: Default logging verbosity is set to DEBUG" in text


def test_another_thread_can_end_it(launch):
    threads = []

    def end(context):
        threads.append(threading.Thread(target=context.emit_event_sync, args=[Shutdown().event]))
        threads[0].start()

    process = ExecuteProcess(cmd=["sleep", "100"])
    outcome = launch(
        process, RegisterEventHandler(OnProcessStart(on_start=lambda _, context: end(context)))
    )
    threads[0].join()
    assert outcome.status == 0
    assert process.return_code == -2


def test_two_errors_at_once_are_one_shutdown(launch):
    async def fail():
        raise ValueError("boom")

    actions = [OpaqueCoroutine(coroutine=fail, ignore_context=True) for _ in range(2)]
    shutdown = OnShutdown(on_shutdown=[LogInfo(msg="ends")])
    outcome = launch(RegisterEventHandler(shutdown), *actions)
    assert (outcome.status, outcome.messages) == (1, ["ends"])


def test_a_handler_that_raises_a_cancellation_ends_the_launch_as_others(launch):
    def fail(_context):
        raise asyncio.CancelledError("boom")

    process = ExecuteProcess(cmd=["sleep", "100"])
    outcome = launch(process, OpaqueFunction(function=fail))
    assert (outcome.status, outcome.error, process.return_code) == (1, "boom", -2)


def test_two_threads_at_once_shut_a_launch_down_once():
    service, both, shutdowns = LaunchService(noninteractive=True), threading.Barrier(2), []

    class RunThatBothThreadsSee:
        @property
        def is_shutdown(self):
            both.wait(60)
            return False

    run, service._run = service._run, RunThatBothThreadsSee()
    threads = [threading.Thread(target=service.shutdown) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    service._run = run
    handler = OnShutdown(on_shutdown=lambda *_: shutdowns.append(1))
    service.context.register_event_handler(handler)
    assert service.run() == 0
    assert shutdowns == [1]


@pytest.mark.parametrize("times", [1, 2])
def test_a_cancelled_launch_shuts_down_and_its_next_run_is_new(times):
    service = LaunchService(noninteractive=True)
    process = ExecuteProcess(cmd=["sleep", "100"], respawn=True)
    starts, shutdowns = [], []

    def cancel(event, _context):
        starts.append(event)
        service.task.cancel()

    def shut_down(event, _context):
        shutdowns.append(event)
        if times == 2:
            service.task.cancel()

    service.context.register_event_handler(OnProcessStart(on_start=cancel))
    service.context.register_event_handler(OnShutdown(on_shutdown=shut_down, handle_once=True))
    timer = TimerAction(period=100.0, actions=[])
    service.include_launch_description(LaunchDescription([process, timer]))

    async def run_twice():
        with pytest.raises(asyncio.CancelledError):
            await asyncio.ensure_future(service.run_async())
        assert len(shutdowns) == 1
        assert service.context.is_shutdown
        assert process.get_asyncio_future().done()
        assert timer.get_asyncio_future().done()
        return await service.run_async()

    assert asyncio.run(run_twice()) == 0
    assert len(starts) == 1


def test_the_next_run_forgets_a_failure():
    service = LaunchService(noninteractive=True)

    def fail(_context):
        raise ValueError("boom")

    service.include_launch_description(LaunchDescription([OpaqueFunction(function=fail)]))
    assert service.run() == 1
    assert service.run() == 0


def test_the_next_run_forgets_a_ctrl_c():
    service, reasons = LaunchService(noninteractive=True), []
    handler = OnShutdown(on_shutdown=lambda event, _: reasons.append(event.reason))
    service.context.register_event_handler(handler)
    interrupt = OpaqueFunction(function=lambda _: signal.raise_signal(signal.SIGINT))
    for _ in range(2):
        service.include_launch_description(LaunchDescription([interrupt]))
        assert service.run() == 0
    assert reasons == ["ctrl-c (SIGINT)"] * 2


@pytest.mark.parametrize("blocks_again", [False, True])
def test_the_third_ctrl_c_ends_a_blocked_launch_and_all_its_work(blocks_again):
    def block(*_):
        for _ in range(3):
            signal.raise_signal(signal.SIGINT)

    service, process = LaunchService(noninteractive=True), ExecuteProcess(cmd=["sleep", "100"])
    timer, shutdowns = TimerAction(period=100.0, actions=[]), []

    def shut_down(*_):
        shutdowns.append(1)
        if blocks_again:
            block()

    for handler in (
        OnProcessStart(on_start=block),
        OnShutdown(on_shutdown=shut_down, handle_once=True),
    ):
        service.context.register_event_handler(handler)
    service.include_launch_description(LaunchDescription([timer, process]))
    with pytest.raises(KeyboardInterrupt):
        service.run()
    assert process.get_asyncio_future().done()
    assert timer.get_asyncio_future().done()
    assert shutdowns == [1]
    assert service.run() == 0


def test_it_runs_in_another_thread_too():
    service = LaunchService(noninteractive=True)
    started, ended = threading.Event(), threading.Event()
    process = ExecuteProcess(cmd=["sleep", "100"])
    handlers = [
        OnProcessStart(on_start=lambda *_: started.set()),
        OnShutdown(on_shutdown=lambda *_: ended.set()),
    ]
    service.include_launch_description(
        LaunchDescription([process, *map(RegisterEventHandler, handlers)])
    )
    statuses = []
    thread = threading.Thread(target=lambda: statuses.append(service.run()))
    thread.start()
    assert started.wait(60)
    with pytest.raises(RuntimeError, match="cannot be run multiple times concurrently"):
        service.run()
    service.shutdown()
    thread.join(60)
    assert statuses == [0]
    assert ended.is_set()


def test_it_can_stay_though_idle():
    service = LaunchService()
    thread = threading.Thread(target=lambda: service.run(shutdown_when_idle=False))
    thread.start()
    seen = threading.Event()
    handler = EventHandler(matcher=is_ping, entities=lambda *_: seen.set())
    service.include_launch_description(
        LaunchDescription([RegisterEventHandler(handler), EmitEvent(event=Ping())])
    )
    assert seen.wait(60)
    assert thread.is_alive()
    service.shutdown()
    thread.join(60)
    assert not thread.is_alive()


# Signals, at `ros2 launch` in a separate process or terminal.

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
    launch.wait_for("hanging")
    for number in range(1, 4):
        launch.type("\x03")
        # Two signals at once count as one. The terminal shows ^C when it sends the signal, and
        # after two more lines the process has seen it.
        launch.wait_for(r"\^C", count=number)
        if number < 3:
            launch.wait_for("hanging", count=launch.text.count("hanging") + 2)
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
