"""The order of events and handlers, failures, and the end."""

import signal
import threading

import pytest

from launch import EventHandler, LaunchDescription, LaunchService
from launch.action import Action
from launch.actions import (
    EmitEvent,
    ExecuteProcess,
    LogInfo,
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


def test_the_next_run_forgets_a_failure():
    service = LaunchService(noninteractive=True)

    def fail(_context):
        raise ValueError("boom")

    service.include_launch_description(LaunchDescription([OpaqueFunction(function=fail)]))
    assert service.run() == 1
    assert service.run() == 0


def test_the_next_run_forgets_a_ctrl_c(caplog):
    service = LaunchService(noninteractive=True)
    interrupt = OpaqueFunction(function=lambda _: signal.raise_signal(signal.SIGINT))
    for _ in range(2):
        service.include_launch_description(LaunchDescription([interrupt]))
        assert service.run() == 0
        assert caplog.messages[-1] == "user interrupted with ctrl-c (SIGINT)"


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
