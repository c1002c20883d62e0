"""Forged points: a submission that attacks the graders does not pass."""

import contextlib
import json
import os
import sys
import tempfile
import threading
from pathlib import Path

import pytest

from turtle_class.catalogue import chosen
from turtle_class.grading import grade_all
from turtle_class.runner import Limits, Runner, _facts
from turtlewire.cli.main import main

from .conftest import FILE, silly

(CARROT,) = chosen(["fixed_carrot"])
PATIENT = Limits(seconds=250.0)
#: What the child would write if all were well.
NAMES = [
    "The frame carrot1 is a child of turtle1",
    "The carrot is one metre behind turtle1",
    "The carrot stays there while turtle1 drives and turns",
    "Turtle2 comes to the carrot",
]
UNTOLD = {"text": "", "hint": "", "file": "", "line": 0}
FACTS = [*({"result": {"check": name, "passed": True, **UNTOLD}} for name in NAMES), {"end": True}]
FORGED = "".join(f"{json.dumps(fact)}\n" for fact in FACTS)

PRELUDE = f"""
import contextlib, ctypes, glob, os, sys
FORGED = {FORGED!r}
#: The folder that the graders made for this run.
GRADING = os.path.dirname(os.getcwd())

# The processes of the grading above this one, and no others: the test touches nothing else.
def graders():
    pid = os.getppid()
    while pid > 1:
        with open(f"/proc/{{pid}}/cmdline", "rb") as file:
            words = file.read().decode().split("\\0")
        if not any(word.endswith(("turtle_class.child", "supervise.py")) for word in words):
            return
        yield pid, words
        with open(f"/proc/{{pid}}/stat") as file:
            pid = int(file.read().rpartition(")")[2].split()[1])

def attempt(what, call):
    try:
        print(what, "worked:", call())
    except BaseException as error:
        print(what, "failed:", type(error).__name__)
"""

#: Each is run when the student's file is imported; then the process ends, so that nothing else is
#: written after it.
ATTACKS = {
    "files on the command lines": """
words = [*sys.argv, *sys.orig_argv, *(word for _, words in graders() for word in words)]
for path in words:
    if os.path.isabs(path) and (path.startswith(GRADING) or path.endswith("results")):
        with contextlib.suppress(OSError), open(path, "a") as file:
            file.write(FORGED)
os._exit(0)
""",
    "files near the own folder": """
for path in ("../results", "results", os.path.expanduser("~/results")):
    with contextlib.suppress(OSError), open(path, "a") as file:
        file.write(FORGED)
os._exit(0)
""",
    "descriptors of the graders": """
for pid, _ in graders():
    for number in range(64):
        path = f"/proc/{pid}/fd/{number}"
        # No plain file: where the graders are not hidden, it would be overwritten.
        with contextlib.suppress(OSError):
            if os.readlink(path).startswith(("pipe:", "socket:")):
                with open(path, "w") as file:
                    file.write(FORGED)
os._exit(0)
""",
    "own descriptors": """
for number in range(64):
    with contextlib.suppress(OSError):
        os.write(number, FORGED.encode())
os._exit(0)
""",
    "own answers": """
for number in range(64):
    with contextlib.suppress(OSError):
        os.write(number, b'{"news": {"nodes": [], "opened": [{}], "closed": [7]}}\\n' * 99)
""",
    "modules of the checks": """
import turtle_lesson.exercise, turtle_lesson.grading
turtle_lesson.exercise.Exercise.expect = lambda *_: None
turtle_lesson.exercise.NotYet = type("Never", (Exception,), {})
turtle_lesson.grading._run = lambda check, *_: turtle_lesson.grading.LessonResult("x", True)
turtle_lesson.grading.grade.__defaults__ = (None,)
""",
    "objects of the checks": """
import gc, inspect
for found in gc.get_objects():
    if type(found).__name__ in {"Lesson", "Exercise", "StudentProcess"}:
        print("found", type(found).__name__)
        os._exit(0)
frame = inspect.currentframe()
while frame is not None:
    if "tell" in frame.f_locals:
        frame.f_locals["tell"](end=True)
    frame = frame.f_back
""",
    "modules that the graders import later": """
for name in ("yaml", "json", "checks", "tf_transformations"):
    for folder in (".", "..", os.path.expanduser("~")):
        with open(os.path.join(folder, name + ".py"), "w") as file:
            file.write("import os; os.write(1, " + repr(FORGED.encode()) + "); os._exit(0)")
""",
}


def hostile(attack):
    """A solution that lacks its carrot, and attacks."""
    return PRELUDE + attack + silly("solved").replace("'carrot1'", "'carrot'")


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="the attacks look for processes in /proc")
@pytest.mark.parametrize("name", ATTACKS)
def test_an_attack_gives_no_points(tmp_path, name):
    (tmp_path / FILE).write_text(hostile(ATTACKS[name]), encoding="utf-8")
    outcome = Runner(PATIENT).run(CARROT, tmp_path, 99)
    assert outcome.points == 0
    assert [result.check for result in outcome.results] == NAMES
    assert outcome.results[0].state == "failed"
    assert "found" not in outcome.log


PEEK = """
for pid, _ in graders():
    attempt("memory", lambda: open(f"/proc/{pid}/mem", "r+b"))
    attempt("environment", lambda: open(f"/proc/{pid}/environ", "rb").read())
    attempt("descriptors", lambda: open(f"/proc/{pid}/fd/1", "a"))
    PTRACE_ATTACH = 16
    libc = ctypes.CDLL(None, use_errno=True)
    libc.ptrace.argtypes = [ctypes.c_long] * 4
    libc.ptrace.restype = ctypes.c_long
    if libc.ptrace(PTRACE_ATTACH, pid, 0, 0) == 0:
        print("ptrace worked")
        os._exit(0)
    print("graders seen")
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="only Linux has /proc and capabilities")
def test_the_processes_of_the_graders_are_closed(tmp_path):
    (tmp_path / FILE).write_text(PRELUDE + PEEK + silly("solved"), encoding="utf-8")
    [report] = grade_all([tmp_path.parent], [CARROT._replace(name=tmp_path.name)], PATIENT)
    [outcome] = report.outcomes
    assert outcome.passed, outcome
    assert outcome.log.count("graders seen") >= 2
    assert "worked" not in outcome.log
    assert outcome.log.count("memory failed: PermissionError") >= 2


def write_into_pipe(descriptor):
    """Write into another process's pipe; never into a file, which root would overwrite."""
    with contextlib.suppress(OSError):
        flags = (descriptor.parents[1] / "fdinfo" / descriptor.name).read_text().split()[3]
        # Pipes that are closed on exec belong to `subprocess`, and only root reaches them: data in
        # the pipe that reports a failed exec makes `subprocess` wait until the process ends.
        if os.readlink(descriptor).startswith("pipe:") and not int(flags, 8) & os.O_CLOEXEC:
            pipe = os.open(descriptor, os.O_WRONLY | os.O_NONBLOCK)  # it may be full
            try:
                os.write(pipe, FORGED.encode())
            finally:
                os.close(pipe)


@pytest.mark.skipif(sys.platform != "linux", reason="the attack looks for processes in /proc")
def test_code_that_is_graded_at_the_same_time_reaches_no_results(tmp_path, monkeypatch):
    """A neighbour watches for the processes of an exercise from their first moment on."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    (tmp_path / "student").mkdir()
    (tmp_path / "student" / FILE).write_text(hostile(""), encoding="utf-8")
    over, seen = threading.Event(), set()

    def write_into_results():
        while not over.is_set():
            for pid in filter(str.isdigit, os.listdir("/proc")):
                with contextlib.suppress(OSError):
                    words = Path("/proc", pid, "cmdline").read_bytes()
                    if b"turtle_class.child" in words and os.fsencode(tmp_path) in words:
                        seen.add(pid)
                        for number in range(1, 16):
                            write_into_pipe(Path("/proc", pid, "fd", str(number)))

    neighbour = threading.Thread(target=write_into_results)
    neighbour.start()
    try:
        outcome = Runner(PATIENT).run(CARROT, tmp_path / "student", 99)
    finally:
        over.set()
        neighbour.join()
    assert seen
    assert outcome.points == 0
    assert [result.check for result in outcome.results] == NAMES


@pytest.mark.parametrize(
    "line",
    [
        '{"result": {}}',
        "5",
        '{"result": 5}',
        '{"result": {"check": "x", "passed": 1, "text": "", "hint": "", "file": "", "line": 0}}',
        '{"checks": 5}',
        '{"a": 1, "b": 2}',
        "[" * 30_000,
        '{"result": {"check": "x"',
    ],
)
def test_lines_that_are_no_facts_are_left_out(line):
    good = '{"checks": ["a", "b"]}'
    facts = _facts(f"{good}\n{line}\n" + '{"end": true}\n')
    assert facts == (["a", "b"], [], True)


@pytest.mark.slow
def test_an_exercise_whose_grading_fails_does_not_end_the_class(
    submissions, tmp_path, capsys, monkeypatch
):
    run = Runner.run

    def failing(self, exercise, folder, domain):
        if folder.parent.name == "breaks":
            raise RuntimeError("no grader")
        return run(self, exercise, folder, domain)

    monkeypatch.setattr(Runner, "run", failing)
    folder = submissions({"breaks": silly("solved"), "solved": silly("solved")})
    reports = tmp_path / "reports"
    assert main(["class", "grade", str(folder), "-o", str(reports), "-e", "fixed_carrot"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[:2] == ["breaks  0 of 1 solved", "solved  1 of 1 solved"]
    assert "no grader" in (reports / "breaks.html").read_text(encoding="utf-8")
