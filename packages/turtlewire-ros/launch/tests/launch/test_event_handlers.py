"""Event handlers and the events of processes, without a running launch."""

import signal

import pytest

from launch import EventHandler, LaunchContext, LaunchDescription
from launch.actions import ExecuteProcess, LogInfo, TimerAction
from launch.event_handlers import (
    OnActionEventBase,
    OnExecutionComplete,
    OnIncludeLaunchDescription,
    OnProcessExit,
    OnProcessIO,
    OnProcessStart,
    OnShutdown,
)
from launch.event_handlers.on_shutdown import gen_handler
from launch.events import (
    ExecutionComplete,
    IncludeLaunchDescription,
    Shutdown,
    TimerEvent,
    matchers,
)
from launch.events.process import (
    ProcessExited,
    ProcessStarted,
    ProcessStderr,
    ProcessStdout,
    ShutdownProcess,
    SignalProcess,
)


@pytest.fixture
def process():
    return ExecuteProcess(cmd=["/bin/echo", "x"])


@pytest.fixture
def other():
    return ExecuteProcess(cmd=["/bin/true"])


def details(action, pid=7):
    return {
        "action": action,
        "name": "echo-1",
        "cmd": ["/bin/echo", "x"],
        "cwd": None,
        "env": None,
        "pid": pid,
    }


def started(action):
    return ProcessStarted(**details(action))


@pytest.mark.parametrize(
    ("handler_class", "keyword", "make"),
    [
        (OnProcessStart, "on_start", started),
        (OnProcessExit, "on_exit", lambda a: ProcessExited(returncode=0, **details(a))),
    ],
)
def test_a_handler_of_process_events_knows_its_process(
    process, other, handler_class, keyword, make
):
    entity = LogInfo(msg="x")
    own = handler_class(target_action=process, **{keyword: entity})
    each = handler_class(**{keyword: entity})
    chosen = handler_class(target_action=lambda action: action is other, **{keyword: entity})
    assert [h.matches(make(process)) for h in (own, each, chosen)] == [True, True, False]
    assert [h.matches(make(other)) for h in (own, each, chosen)] == [False, True, True]
    assert not own.matches(Shutdown())
    assert own.handle(make(process), LaunchContext()) == [entity]
    assert own.describe()[1] == [entity]
    assert each.matcher_description == f"event == {type(make(process)).__name__}"
    assert own.matcher_description.startswith(f"{each.matcher_description} and event.action == <")
    assert own.handler_description == "<actions>"


def test_each_stream_has_its_function(process):
    seen = []
    handler = OnProcessIO(
        target_action=process,
        on_stdout=lambda event: seen.append(("out", event.text)),
        on_stderr=lambda event: seen.append(("err", event.text)),
    )
    context = LaunchContext()
    for event in (
        ProcessStdout(text=b"1", **details(process)),
        ProcessStderr(text=b"2", **details(process)),
    ):
        assert handler.matches(event)
        handler.handle(event, context)
    assert seen == [("out", b"1"), ("err", b"2")]
    silent = OnProcessIO(target_action=process)
    assert silent.handle(ProcessStdout(text=b"1", **details(process)), context) is None


def test_streams_are_told_apart(process):
    out = ProcessStdout(text=b"1", **details(process))
    err = ProcessStderr(text=b"1", **details(process))
    assert (out.from_stdin, out.from_stdout, out.from_stderr) == (False, True, False)
    assert (err.from_stdin, err.from_stdout, err.from_stderr) == (False, False, True)


def test_a_function_gets_event_and_context(process):
    def react(event, context):
        return [event, context]

    handler = OnProcessStart(target_action=process, on_start=react)
    event, context = started(process), LaunchContext()
    assert handler.handle(event, context) == [event, context]
    assert context.locals.event is event
    assert handler.handler_description == str(react)
    assert handler.describe()[1] == []


def test_a_handler_that_handles_once_unregisters():
    context = LaunchContext()
    handler = OnShutdown(on_shutdown=[], handle_once=True)
    assert handler.handle_once
    context.register_event_handler(handler)
    handler.handle(Shutdown(), context)
    assert not context.would_handle_event(Shutdown())


def test_completions_and_inclusions():
    action = LogInfo(msg="x")
    handler = OnExecutionComplete(target_action=action, on_completion=[])
    assert handler.matches(ExecutionComplete(action=action))
    assert not handler.matches(ExecutionComplete(action=LogInfo(msg="y")))
    description = LaunchDescription([])
    event = IncludeLaunchDescription(description)
    including = OnIncludeLaunchDescription()
    assert including.matches(event)
    assert not including.matches(Shutdown())
    assert including.handle(event, LaunchContext()) == [description]
    assert including.matcher_description == "event is IncludeLaunchDescription"


def test_descriptions():
    text = "EventHandler(matcher='{OMITTED}', handler='<actions>', handle_once=True)"
    assert EventHandler(matcher=bool, entities=[], handle_once=True).describe() == (text, [])
    text = "OnShutdown(matcher='event is Shutdown', handler='<actions>', handle_once=False)"
    assert OnShutdown(on_shutdown=[]).describe()[0] == text


def test_the_base_of_action_handlers_checks_its_matcher():
    with pytest.raises(ValueError, match="must be a 'TimerAction' instance or a callable, not 3"):
        OnActionEventBase(
            action_matcher=3,
            on_event=[],
            target_event_cls=TimerEvent,
            target_action_cls=TimerAction,
        )


def test_events_tell_what_happened(process):
    event = ProcessExited(returncode=-2, **details(process))
    assert event.returncode == -2
    assert event.action is event.execute_process_action is process
    assert (event.process_name, event.cmd, event.cwd, event.env, event.pid) == (
        "echo-1",
        ["/bin/echo", "x"],
        None,
        None,
        7,
    )
    assert event.name == "launch.events.process.ProcessExited"
    timer = TimerAction(period=1.0, actions=[])
    assert TimerEvent(timer_action=timer).timer_action is timer
    shutdown = Shutdown(reason="enough", due_to_sigint=True)
    assert (shutdown.reason, shutdown.due_to_sigint) == ("enough", True)


def test_signals_have_numbers_and_names():
    everyone = matchers.matches_name("echo-1")
    for number in ("SIGTERM", signal.SIGTERM, int(signal.SIGTERM)):
        event = SignalProcess(signal_number=number, process_matcher=everyone)
        assert (event.signal, event.signal_name) == (signal.SIGTERM, "SIGTERM")
        assert event.process_matcher is everyone
    with pytest.raises(KeyError):
        SignalProcess(signal_number="SIGNOTHING", process_matcher=everyone)
    assert ShutdownProcess(process_matcher=everyone).process_matcher is everyone


class Runner:
    """All that events and matchers know of the action that runs a process."""

    def __init__(self, process_details):
        self.process_details = process_details


def test_matchers():
    running = Runner({"pid": 7, "name": "echo-1", "cmd": ["/bin/echo", "x"]})
    waiting = Runner(None)
    for matches, misses in (
        (matchers.matches_pid(7), matchers.matches_pid(8)),
        (matchers.matches_name("echo-1"), matchers.matches_name("echo-2")),
        (matchers.matches_executable("echo"), matchers.matches_executable("/bin/echo")),
        (matchers.matches_action(running), matchers.matches_action(waiting)),
    ):
        assert matches(running)
        assert not misses(running)
        assert not matches(waiting)


def test_a_function_that_returns_fixed_entities():
    entities = [LogInfo(msg="end")]
    handler = OnShutdown(on_shutdown=gen_handler(entities))
    assert handler.handle(Shutdown(), LaunchContext()) is entities
