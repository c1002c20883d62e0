"""The state of one launch and its scopes; lists, types and output, which all entities use."""

import asyncio
import os
import signal
import subprocess
import sys
import threading
from contextlib import closing
from pathlib import Path

import pytest

from launch import Action, BaseEventHandler, Event, LaunchContext, LaunchService
from launch._kernel.run import Run
from launch.actions import LogInfo, TimerAction
from launch.events import Shutdown
from launch.launch_context import Scopes
from launch.process_output import OutputLines, ProcessOutput
from launch.substitutions import LaunchConfiguration, TextSubstitution
from launch.utilities import (
    AsyncSafeSignalManager,
    ensure_argument_type,
    is_a,
    is_a_subclass,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from launch.utilities.raised_in import raised_in


def running(coroutine_function):
    """Runs a coroutine function with a launch that has begun."""

    async def main():
        run = Run()
        run.begin()
        try:
            return await asyncio.wait_for(coroutine_function(run), 60)
        finally:
            run.end()

    return asyncio.run(main())


def test_events_come_in_their_order_and_later_ones_later():
    run = Run()
    first, second, third = Event(), Event(), Event()
    run.emit(first)
    run.emit(second)
    taken = run.take_events()
    run.emit(third)
    assert taken == [first, second]
    assert run.take_events() == [third]
    assert run.take_events() == []


def test_an_event_from_another_thread_ends_the_wait():
    async def wait(run):
        event = Event()
        thread = threading.Thread(target=run.emit, args=(event,))
        thread.start()
        await run.wait()
        thread.join()
        assert run.take_events() == [event]

    running(wait)


def test_an_event_that_came_before_the_wait_is_not_waited_for():
    async def wait(run):
        run.emit(Event())
        await run.wait()

    running(wait)


async def test_events_before_the_start_and_after_the_end_are_kept():
    run = Run()
    early, late = Event(), Event()
    run.emit(early)

    run.begin()
    await run.wait()
    assert run.take_events() == [early]
    run.end()
    run.emit(late)
    run.begin()
    await run.wait()
    assert run.take_events() == [late]


def test_a_future_that_is_done_ends_the_wait_and_gives_its_error():
    async def wait(run):
        future = run.loop.create_future()
        cancelled = run.loop.create_future()
        run.keep_running_for(future)
        run.keep_running_for(future)
        run.keep_running_for(cancelled)
        assert run.is_busy
        assert run.take_errors() == []
        cancelled.cancel()
        error = ValueError("broken")
        run.loop.call_soon(future.set_exception, error)
        await run.wait()
        while run.is_busy:
            found = run.take_errors()
            if found:
                assert found == [error]
            else:
                await run.wait()
        assert run.take_errors() == []

    running(wait)


def test_an_end_is_forgotten_at_the_next_start():
    async def look(run):
        run.is_shutdown = True
        run.end()
        run.begin()
        assert not run.is_shutdown

    running(look)


def test_a_cancellation_waits_until_the_processes_have_ended():
    async def stop(run):
        child = subprocess.Popen(  # noqa: ASYNC220  asyncio would tell later that it has ended
            ["sleep", "100"], env=run.marked(os.environ)
        )
        stopping = asyncio.ensure_future(run.stop_processes())
        run.loop.call_soon(stopping.cancel)
        with pytest.raises(asyncio.CancelledError):
            await stopping
        assert child.poll() == -signal.SIGTERM

    running(stop)


def test_a_cancellation_waits_until_the_rest_is_cancelled():
    async def cancel(run):
        release, ends = asyncio.Event(), []

        async def end_slowly():
            try:
                await run.loop.create_future()
            finally:
                await release.wait()
                run.emit(Event())
                ends.append(1)

        work = asyncio.ensure_future(end_slowly())
        run.keep_running_for(work)
        await asyncio.sleep(0)  # lets the work start
        cancelling = asyncio.ensure_future(run.cancel_rest())
        run.loop.call_soon(cancelling.cancel)
        run.loop.call_soon(run.loop.call_soon, release.set)
        with pytest.raises(asyncio.CancelledError):
            await cancelling
        assert ends == [1]
        assert not run.is_busy

    running(cancel)


def handler(name, log=None):
    made = BaseEventHandler(matcher=lambda event: event.name == name)
    if log is not None:
        made.handle = lambda event, context: log.append(name)
    return made


def test_handlers_are_asked_newest_first_or_last():
    run = Run()
    context = LaunchContext(run=run)
    first, second, last = handler("a"), handler("b"), handler("c")
    context.register_event_handler(first)
    context.register_event_handler(second)
    context.register_event_handler(last, append=True)
    assert run.handlers() == (second, first, last)
    context.unregister_event_handler(first)
    assert run.handlers() == (second, last)
    with pytest.raises(ValueError, match="not in deque"):
        context.unregister_event_handler(first)


def test_a_context_tells_whether_an_event_would_be_handled():
    context = LaunchContext()
    assert not context.would_handle_event(Shutdown())
    context.register_event_handler(handler(Shutdown.name))
    assert context.would_handle_event(Shutdown())
    assert not context.would_handle_event(Event())


def test_a_handler_needs_no_base_class():
    """The kernel knows handlers and entities by what they do."""

    class Entity:
        def visit(self, context):
            seen.append(context.get_locals_as_dict()["number"])

        def get_asyncio_future(self):
            return None

    class Handler:
        def matches(self, event):
            return isinstance(event, Shutdown)

        def handle(self, event, context):
            context.extend_locals({"number": 7})
            return Entity()

    seen = []
    service = LaunchService(noninteractive=True)
    service.context.register_event_handler(Handler())
    assert service.run() == 0
    assert seen == [7]
    assert service.context.get_locals_as_dict() == {}  # they end with the event


def test_two_launches_share_nothing():
    one, other = LaunchService(noninteractive=True), LaunchService(noninteractive=True)
    one.context.register_event_handler(handler("x"))
    one.context.launch_configurations["x"] = "1"
    assert not other.context.would_handle_event(type("X", (Event,), {"name": "x"})())
    assert other.context.launch_configurations == {}
    one.emit_event(Shutdown())
    assert one.run() == other.run() == 0


def test_scopes_put_a_mapping_back_in_place():
    values = {"kept": 1, "changed": 2, "removed": 3}
    scopes = Scopes(values, "values")
    scopes.push()
    values["changed"] = 4
    del values["removed"]
    scopes.push()
    values["added"] = 5
    scopes.pop()
    assert values == {"kept": 1, "changed": 4}
    scopes.pop()
    assert values == {"kept": 1, "changed": 2, "removed": 3}
    with pytest.raises(RuntimeError, match=r"^values stack unexpectedly empty$"):
        scopes.pop()


def test_a_context_resets_the_environment_to_that_of_its_beginning(monkeypatch):
    monkeypatch.setenv("TEST_BEFORE", "1")
    context = LaunchContext()
    monkeypatch.setenv("TEST_AFTER", "2")
    monkeypatch.delenv("TEST_BEFORE")
    context.reset_environment()
    assert os.environ["TEST_BEFORE"] == "1"
    assert "TEST_AFTER" not in os.environ


def test_locals_are_attributes_and_globals_stay():
    context = LaunchContext()
    context.extend_globals({"always": 1, "hidden": 2})
    context.local_scopes.push()
    context.extend_locals({"now": 3, "hidden": 4})
    assert (context.locals.always, context.locals.now, context.locals.hidden) == (1, 3, 4)
    context.local_scopes.pop()
    assert context.locals.hidden == 2
    with pytest.raises(AttributeError, match=r"no attribute 'now', available .*: \['always', 'h"):
        _ = context.locals.now


# Lists of substitutions, type checks, lines of output, and the place of an error.


def test_text_paths_and_substitutions_become_one_list():
    substitution = LaunchConfiguration("x", default="3")
    parts = normalize_to_list_of_substitutions(["a", Path("b/c"), substitution])
    assert [type(part) for part in parts[:2]] == [TextSubstitution] * 2
    assert parts[2] is substitution
    assert perform_substitutions(LaunchContext(), parts) == "ab/c3"
    assert normalize_to_list_of_substitutions(substitution) == [substitution]
    assert normalize_to_list_of_substitutions([]) == []


@pytest.mark.parametrize(("value", "error"), [(3, "is neither text nor"), ([3], "given item of")])
def test_other_values_are_refused(value, error):
    with pytest.raises(TypeError, match=error):
        normalize_to_list_of_substitutions(value)


def test_type_checks():
    action = LogInfo(msg="x")
    assert is_a(action, Action)
    assert not is_a(LogInfo, Action)
    assert is_a_subclass(action, Action)
    assert is_a_subclass(LogInfo, Action)
    assert not is_a_subclass(str, Action)
    ensure_argument_type("x", (int, str), "x")
    with pytest.raises(
        TypeError,
        match=r"^Expected 'x' of Y to be of type 'int', but got 'a' of type '<class 'str'>'$",
    ):
        ensure_argument_type("a", int, "x", "Y")
    with pytest.raises(TypeError, match=r"to be of type one of \['int', 'float'\], but got"):
        ensure_argument_type("a", [int, float], "x")


def test_lines_are_complete_before_they_are_shown():
    lines = OutputLines()
    assert lines.feed(b"a") == []
    assert lines.feed(b"b\r\nc\n\nd") == ["ab", "c", ""]
    assert lines.rest() == ["d"]
    assert lines.rest() == []


def test_a_character_may_come_in_pieces():
    lines = OutputLines()
    encoded = "Größe\n".encode()
    assert lines.feed(encoded[:3]) == []
    assert lines.feed(encoded[3:]) == ["Größe"]


def test_output_is_kept_only_on_request():
    kept, dropped = ProcessOutput("log", cached=True), ProcessOutput("log", cached=False)
    for output in (kept, dropped):
        output.keep(1, b"out")
        output.keep(2, b"er")
        output.keep(2, b"r")
    assert (kept.kept(1), kept.kept(2)) == (b"out", b"err")
    assert (dropped.kept(1), dropped.kept(2)) == (b"", b"")


def test_the_environment_replaces_the_choice_of_outputs(monkeypatch):
    assert ProcessOutput({"stdout": "log"}, cached=False).destination == {"stdout": "log"}
    monkeypatch.setenv("OVERRIDE_LAUNCH_PROCESS_OUTPUT", "both")
    (chosen,) = ProcessOutput({"stdout": "log"}, cached=False).destination
    assert chosen.text == "both"


def test_an_error_from_no_launch_file_has_no_place():
    with pytest.raises(ValueError, match="seven") as caught:
        int("seven")
    assert raised_in(caught.value) == ""


def send_to_this_thread(number):
    signal.pthread_kill(threading.get_ident(), number)


@pytest.mark.skipif(sys.platform == "win32", reason="no signal can be raised without an end")
def test_signals_become_calls_of_a_loop():
    before = signal.getsignal(signal.SIGUSR1)
    calls = []

    async def until(count):
        while len(calls) < count:
            changed.clear()
            await changed.wait()

    def note(name):
        def handler(number):
            calls.append((name, number, threading.get_ident()))
            changed.set()

        return handler

    with closing(asyncio.new_event_loop()) as loop:
        changed = asyncio.Event()
        with AsyncSafeSignalManager(loop) as manager:
            first, second = note("first"), note("second")
            assert manager.handle(signal.SIGUSR1, first) is None
            signal.raise_signal(signal.SIGUSR1)
            assert calls == []
            loop.run_until_complete(until(1))
            assert manager.handle(signal.SIGUSR1, second) is first
            # Received by another thread, a signal does not end the wait of the main thread.
            other = threading.Timer(0.3, send_to_this_thread, args=[signal.SIGUSR1])
            other.start()
            loop.run_until_complete(until(2))
            other.join()
        assert [(name, number) for name, number, _ in calls] == [
            ("first", signal.SIGUSR1),
            ("second", signal.SIGUSR1),
        ]
    assert signal.getsignal(signal.SIGUSR1) == before


def test_arguments_of_a_timer_have_a_type():
    for period in (1, 1.5, "2", TextSubstitution(text="3"), ["4"]):
        TimerAction(period=period, actions=[])
    with pytest.raises(TypeError, match="'period' of TimerAction to be of type one of"):
        TimerAction(period=None, actions=[])
