"""Lists of substitutions, type checks, lines of output, and the place of an error."""

import asyncio
import signal
import sys
import threading
from contextlib import closing
from pathlib import Path

import pytest

from launch import Action, LaunchContext
from launch.actions import LogInfo, TimerAction
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
