"""Calls that must not end their thread."""

import threading

import pytest

from turtlewire import guarded
from turtlewire.guarded import call_guarded


@pytest.fixture
def reported(monkeypatch):
    reports = []
    monkeypatch.setattr(guarded, "_reported", set())
    monkeypatch.setattr(threading, "excepthook", reports.append)
    return reports


def fail(error):
    raise error


def test_an_exception_is_reported_as_the_end_of_a_thread(reported):
    error = LookupError("x")
    call_guarded(fail, error)
    [report] = reported
    assert (report.exc_type, report.exc_value) == (LookupError, error)
    assert report.exc_traceback is error.__traceback__
    assert report.thread is threading.current_thread()


def test_each_line_and_type_is_reported_once(reported):
    for error in (LookupError("1"), LookupError("2"), ValueError("3"), SystemExit("4")):
        call_guarded(fail, error)
    call_guarded([].pop)
    assert [report.exc_type for report in reported] == [
        LookupError,
        ValueError,
        SystemExit,
        IndexError,
    ]


def test_a_report_that_fails_goes_no_further(monkeypatch, reported):
    monkeypatch.setattr(threading, "excepthook", lambda _: fail(BrokenPipeError()))
    call_guarded(fail, LookupError("x"))


def test_lines_without_end_do_not_fill_the_memory(reported):
    for number in range(1001):
        code = compile("\n" * number + "1 / 0", "lines", "exec")
        call_guarded(exec, code)
    assert len(reported) == 1001
    assert len(guarded._reported) == 1


def test_an_interrupt_of_the_main_thread_passes(reported):
    with pytest.raises(KeyboardInterrupt):
        call_guarded(fail, KeyboardInterrupt())
    assert reported == []
