"""Grading: any submission leaves the results of the others intact, and no process behind."""

import json
import os
import select
import signal
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from tests.disks import full_disk
from tests.places import TURTLEWIRE

from turtle_class import runner, supervise
from turtle_class.catalogue import chosen
from turtle_class.runner import Limits, Runner
from turtlewire.cli.main import main

from .conftest import FILE, silly, solution

(CARROT,) = chosen(["fixed_carrot"])


#: Long: Python alone takes seconds to start beside other work.
PATIENT = Limits(seconds=250.0)


def graded(folder, name, limits=None):
    """Grade what a student with this mistake hands in."""
    (folder / FILE).write_text(silly(name), encoding="utf-8")
    return Runner(limits or PATIENT).run(CARROT, folder, 99)


def failure(outcome):
    (found,) = [result for result in outcome.results if result.state == "failed"]
    return found


def test_a_solution_passes(tmp_path):
    outcome = graded(tmp_path, "solved")
    assert outcome.passed
    assert outcome.points == len(outcome.results) >= 3


@pytest.mark.parametrize(
    ("name", "text", "hint"),
    [
        pytest.param(
            "endless",
            "did not return",
            "use a timer instead of a loop",
            marks=pytest.mark.slow,
        ),
        ("exits", "ended with status 0", "Something ended the whole Python process"),
        ("forks", "calls os.fork", "neither starts programs nor ends others"),
        ("crashes", "ended with status", "a library that crashed"),
        ("misspelt", "TransformStampde' is not defined", "correct its spelling"),
        ("eats_memory", "MemoryError", ""),
    ],
)
def test_a_stupid_thing_is_a_result_with_a_hint(tmp_path, name, text, hint):
    outcome = graded(tmp_path, name)
    found = failure(outcome)
    assert text in found.text
    assert hint in found.hint
    assert {result.state for result in outcome.results[1:]} == {"skipped"}
    if name not in {"exits", "crashes"}:
        assert found.file == FILE
        assert found.line > 1


def test_a_program_that_waits_is_ended_after_the_limit(tmp_path):
    found = failure(graded(tmp_path, "waits", Limits(seconds=30.0)))
    assert found.text == "It did not end within 30 s."
    assert "time.sleep()" in found.hint


@pytest.mark.slow
def test_a_flood_of_output_is_cut_and_does_not_fail(tmp_path):
    outcome = graded(tmp_path, "floods", PATIENT._replace(log=5000))
    assert outcome.passed
    assert len(outcome.log) < 5100
    assert outcome.log.endswith("bytes more")


@pytest.mark.parametrize(
    ("spoil", "state", "text"),
    [
        (lambda path: path.unlink(), "skipped", f"{FILE} is missing."),
        (lambda path: path.write_bytes(b"# \xff\n"), "failed", f"{FILE} is not UTF-8"),
        (lambda path: path.write_bytes(b"#" * 2_000_000), "failed", "has 2000000 bytes"),
        (lambda path: (path.unlink(), path.mkdir()), "failed", "is not a regular file"),
        (
            lambda path: (path.unlink(), path.symlink_to("/etc/passwd")),
            "failed",
            "not a regular file",
        ),
    ],
    ids=["missing", "latin1", "huge", "folder", "link"],
)
def test_non_python_file_is_a_failed_result(tmp_path, spoil, state, text):
    (tmp_path / FILE).write_text(solution(), encoding="utf-8")
    spoil(tmp_path / FILE)
    outcome = Runner(PATIENT).run(CARROT, tmp_path, 99)
    (result,) = outcome.results
    assert result.state == state
    assert text in result.text
    assert result.hint


def test_a_file_of_a_million_bytes_is_read(tmp_path):
    (tmp_path / FILE).write_bytes(b"#" * 1_000_000)
    assert len(runner._read(tmp_path, FILE)) == 1_000_000
    (tmp_path / FILE).write_bytes(b"#" * 1_000_001)
    with pytest.raises(runner._UnreadableError, match="has 1000001 bytes"):
        runner._read(tmp_path, FILE)


@pytest.mark.parametrize(
    ("printed", "log"), [(b"12345", "12345"), (b"123456", "12345\n… and 1 byte more")]
)
def test_a_log_that_just_fits_is_whole(printed, log):
    output, end = os.pipe()
    os.write(end, printed)
    os.close(end)
    assert runner._beginning(os.fdopen(output, "rb"), 5) == log


def test_the_students_code_sees_nothing_of_the_teachers_environment(tmp_path, monkeypatch):
    monkeypatch.setenv("SECRET_TOKEN", "abc")
    text = silly("solved").replace(
        "import rclpy\n", "import rclpy\nimport os\nprint(os.environ)\n", 1
    )
    (tmp_path / FILE).write_text(text, encoding="utf-8")
    outcome = Runner(PATIENT).run(CARROT, tmp_path, 99)
    assert "ROS_DOMAIN_ID': '99'" in outcome.log
    assert "SECRET_TOKEN" not in outcome.log


BACKGROUND = """
import os, sys, time
for _ in range(3):
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            os.write(1, b"%d\\n" % os.getpid())
            time.sleep(1e6)
        os._exit(0)
os.write(1, b"begun\\n")
{then}
"""


ON_LINUX = pytest.mark.skipif(
    sys.platform != "linux", reason="only Linux gives orphans to another process"
)
SUPERVISE = ["-I", supervise.__file__]


def supervised(code, seconds=60, by=SUPERVISE):
    """Start code below a supervisor; `by` are Python's words for the supervisor's script."""
    limits = [str(seconds), str(2 << 30)] if by is SUPERVISE else []
    return subprocess.Popen(
        [sys.executable, *by, *limits, sys.executable, "-c", code],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )


@ON_LINUX
@pytest.mark.parametrize(
    ("then", "seconds", "status"),
    [("os._exit(3)", 60, 3), ("time.sleep(1e6)", 15, supervise.TIME_IS_OVER)],
    ids=["ends", "time"],
)
def test_processes_in_the_background_are_ended(then, seconds, status):
    with supervised(BACKGROUND.format(then=then), seconds) as child:
        told = child.stdout.read()  # ends when no process holds the pipe any more
        assert child.wait(60) == status
    assert "begun" in told


#: Each process forks the next one and exits, so the process ids in /proc are out of date.
RUNAWAY = """
import os
os.write(1, b"begun\\n")
if os.fork() == 0:
    os.setsid()
    while os.fork() == 0:
        pass
"""


@ON_LINUX
def test_a_process_that_runs_away_is_ended():
    with supervised(RUNAWAY) as child:
        assert child.stdout.read() == "begun\n"  # ends when no process holds the pipe any more
        assert child.wait(60) == 0


#: The first search of /proc finds no process, as if all had begun meanwhile.
SEARCH_THAT_MISSES = """
import sys
from turtle_class import runner, supervise
searches = [supervise._groups_below] * 100 + [set]
supervise._groups_below = lambda: searches.pop()()
sys.exit(supervise.supervise(60, 2 << 30, sys.argv[1:]))
"""


@ON_LINUX
def test_processes_that_the_first_search_missed_are_ended():
    then = "import signal; signal.alarm(2); signal.pause()"  # by then all of them have begun
    with supervised(BACKGROUND.format(then=then), by=["-c", SEARCH_THAT_MISSES]) as child:
        told = child.stdout.read()  # ends when no process holds the pipe any more
        assert child.wait(60) != supervise.TIME_IS_OVER
    assert "begun" in told


@ON_LINUX
def test_they_end_with_the_grader():
    with supervised(BACKGROUND.format(then="time.sleep(1e6)"), 600) as child:
        lines = [child.stdout.readline() for _ in range(4)]
        child.stdin.close()
        rest = child.stdout.read()  # ends when no process holds the pipe any more
        assert rest == ""
    assert sum(line.strip().isdecimal() for line in lines) == 3


@pytest.mark.slow
def test_reports_of_a_class(submissions, tmp_path, capsys):
    evil = "eve<script>alert(1)<\x1b[2J"
    names = ["solved", "misspelt", "floods"]
    folder = submissions({**{name: silly(name) for name in names}, evil: silly("misspelt")})
    (folder / "absent").mkdir()
    reports = tmp_path / "reports"
    assert main(["class", "grade", str(folder), "-o", str(reports), "-e", "fixed_carrot"]) == 0
    told = capsys.readouterr().out
    assert "solved    " in told
    assert "1 of 1 solved" in told
    assert "\x1b" not in told
    pages = {path.name: path.read_text(encoding="utf-8") for path in reports.glob("*.html")}
    assert len(pages) == 6
    assert not any("<script" in page or "\x1b" in page for page in pages.values())
    overview = pages["index.html"]
    assert overview.count("<tr>") == 7
    assert '<a href="misspelt.html">misspelt</a>' in overview
    assert "eve&lt;script&gt;alert(1)&lt;\\x1b[2J" in overview
    assert "<mark>" in pages["misspelt.html"]
    assert "TransformStampde" in pages["misspelt.html"]
    assert "correct its spelling" in pages["misspelt.html"]
    check_junit(reports / "junit")


def check_junit(folder):
    assert len(list(folder.glob("*.xml"))) == 5
    root = ET.parse(folder / "misspelt.xml").getroot()
    assert (root.get("tests"), root.get("failures"), root.get("skipped")) == ("4", "1", "3")
    (failed,) = root.iter("failure")
    assert "NameError" in failed.get("message")
    assert f"{FILE}, line 1" in failed.text
    solved = ET.parse(folder / "solved.xml").getroot()
    assert (solved.get("failures"), solved.get("skipped")) == ("0", "0")
    absent = ET.parse(folder / "absent.xml").getroot()
    assert [case.get("message") for case in absent.iter("skipped")] == [f"{FILE} is missing."]


def test_a_student_checks_the_own_folder(submissions, tmp_path, capsys):
    folder = submissions({"solved": silly("solved"), "misspelt": silly("misspelt")})
    assert main(["class", "check", str(folder / "solved")]) == 0
    assert capsys.readouterr().out == "fixed_carrot: solved\n"
    xml = tmp_path / "new" / "results.xml"
    assert main(["class", "check", str(folder / "misspelt"), "--junit", str(xml)]) == 1
    told = capsys.readouterr().out
    assert "fixed_carrot: 0 of " in told
    assert "correct its spelling" in told
    assert ET.parse(xml).getroot().get("failures") == "1"


def test_reports_are_not_a_student_the_next_time(tmp_path, monkeypatch, capsys):
    (tmp_path / "ana").mkdir()
    monkeypatch.chdir(tmp_path)
    for _ in range(2):
        assert main(["class", "grade", ".", "-e", "static"]) == 0
        told = capsys.readouterr().out
        assert told == "ana  0 of 1 solved\nThe reports are at reports/index.html\n"


def test_a_full_disk_leaves_the_older_report(tmp_path, monkeypatch, capsys):
    (tmp_path / "ana").mkdir()
    report = tmp_path / "reports" / "ana.html"
    report.parent.mkdir()
    report.write_text("older")
    monkeypatch.chdir(tmp_path)
    with full_disk():
        assert main(["class", "grade", ".", "-e", "static"]) == 2
    assert "reports/ana.html" in capsys.readouterr().err
    assert report.read_text() == "older"


def test_report_files_keep_the_letters_of_names(tmp_path):
    submissions = tmp_path / "in"
    for name in ("Björn", "李雷", "<b> x", "ana", "Ana"):
        (submissions / name).mkdir(parents=True)
    out = tmp_path / "out"
    assert main(["class", "grade", str(submissions), "-e", "static", "-o", str(out)]) == 0
    pages = {path.stem for path in out.glob("*.html")}
    assert pages == {"index", "Björn", "李雷", "_b__x", "Ana", "ana-2"}
    overview = (out / "index.html").read_text(encoding="utf-8")
    assert 'href="Bj%C3%B6rn.html"' in overview


def test_first_files_are_written_once(tmp_path, monkeypatch, capsys):
    folder = tmp_path / "mine"
    assert main(["class", "start", str(folder), "-e", "camera"]) == 0
    assert capsys.readouterr().out == f"1 exercise in {folder}\n"
    assert sorted(path.name for path in (folder / "camera").iterdir()) == [
        "README.md",
        "camera_tf2_broadcaster.py",
        "exercise.launch.py",
    ]
    assert main(["class", "start", str(folder), "-e", "camera"]) == 2
    assert "README.md exists already; nothing was written" in capsys.readouterr().err
    assert main(["class", "check", str(folder)]) == 1
    monkeypatch.chdir(folder / "camera")
    assert main(["class", "check"]) == 2
    assert "`turtlewire class check .. -e camera` checks it" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["grade", "nowhere"], "there is no folder nowhere"),
        (["grade", "."], "holds no folders: it must have one for each student"),
        (["check", "."], "holds no exercise"),
        (["check", "my work/static"], "`turtlewire class check 'my work' -e static` checks it"),
        (["grade", "my work"], "`turtlewire class check 'my work'` checks them"),
        (["check", ".", "-e", "statik"], "there is no exercise 'statik'; choose from static"),
        (["start", ".", "-e", "fixd_carrot"], "Did you mean: fixed_carrot"),
    ],
)
def test_wrong_words_are_answered(tmp_path, monkeypatch, capsys, words, told):
    monkeypatch.chdir(tmp_path)
    if "my work" in words[1]:
        Path("my work/static").mkdir(parents=True)
    assert main(["class", *words]) == 2
    assert told in capsys.readouterr().err


@pytest.mark.parametrize("thread", ["main", "another"])
def test_ctrl_c_ends_grading_and_all_that_runs(submissions, tmp_path, thread):
    folder = submissions({"waits": silly("waits")})
    command = ["class", "grade", folder, "-e", "fixed_carrot", "-o", tmp_path / "out"]
    with subprocess.Popen([TURTLEWIRE, *command]) as grader:
        child = wait_for_child(grader.pid)
        handle = os.pidfd_open(child)
        threads = [grader.pid]
        if thread == "another":
            wait_for_child(child)  # now a thread reads what it prints
            threads = [int(task.name) for task in Path(f"/proc/{grader.pid}/task").iterdir()]
        os.kill(max(threads), signal.SIGINT)
        assert grader.wait(60) == 130
    assert select.select([handle], [], [], 60)[0]
    os.close(handle)
    assert not (tmp_path / "out").exists()


def wait_for_child(pid):
    """Wait until a process has a child; its number."""
    while True:
        for task in Path(f"/proc/{pid}/task").iterdir():
            if children := (task / "children").read_text().split():
                return int(children[0])


def test_the_list(capsys):
    assert main(["class", "list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 11
    assert lines[0].startswith("static ")
    assert main(["class", "list", "--json"]) == 0
    listed = json.loads(capsys.readouterr().out)["exercises"]
    assert len(listed) == 11
    assert listed[0] == {"name": "static", "title": "A static frame"}
