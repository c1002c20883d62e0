"""The data of a running lesson that the page gets, under CPython."""

import json
import struct

import pytest
from tests.places import LESSON_CODE, LESSONS
from tests.programs import run_python

from turtle_lesson import classroom
from turtle_lesson.lesson import load_lesson
from turtle_lesson.session import LessonSession

WISHES = json.dumps({"target": "turtle2", "source": "turtle1", "topic": "/turtle1/pose"})


@pytest.fixture
def open_session():
    """Opens sessions of a lesson with changes of its first file: pairs of texts."""
    sessions = []

    def open_session(name, *changes, solved=False, faults=()):
        lesson = load_lesson(LESSONS / name)
        files = lesson.solution() if solved else lesson.starter()
        for old, new in changes:
            assert old in files[lesson.files[0]]
            files[lesson.files[0]] = files[lesson.files[0]].replace(old, new)
        sessions.append(LessonSession(lesson, files, faults))
        return sessions[-1]

    yield open_session
    for session in sessions:
        session.close()


def texts_of(session, seconds, wishes=WISHES):
    """The newest text of each type after some simulated seconds."""
    newest = {}
    for _ in range(round(seconds / 0.16)):
        newest.update({text["type"]: text for text in map(json.loads, session.step(10, wishes))})
    return newest


def poses_of(frame):
    """Turtles' x and y in the packet for the page, whose first array is their poses."""
    (length,) = struct.unpack_from("<I", frame)
    kind, (size,) = json.loads(frame[4 : 4 + length])["arrays"]["poses"]
    assert kind == "f4"
    return [struct.unpack_from("<2f", frame, 4 + length + 20 * k) for k in range(size // 5)]


def test_the_page_sees_turtles_frames_and_messages(open_session):
    session = open_session("listener")
    assert session.mistake is None
    texts = texts_of(session, 8.0)
    (x1, y1), (x2, y2) = poses_of(session.frame())
    assert abs(x1 - x2) + abs(y1 - y2) < 0.5  # turtle2 has come
    frames = {name: parent for name, parent, *_ in texts["tf"]["frames"]}
    assert frames == {"turtle1": "world", "turtle2": "world"}
    assert abs(texts["tf"]["relation"]["translation"][0]) < 0.5
    assert texts["echo"]["topic"].startswith("x: 5.54")
    assert "/turtle2/cmd_vel" in texts["echo"]["topics"]
    assert "- In words: seen from turtle2, turtle1 is" in texts["echo"]["transform"]
    assert 7.0 < texts["echo"]["seconds"] <= 8.0


def test_a_topic_is_echoed_as_soon_as_a_node_publishes_it(open_session):
    # Its name stays in the page when another lesson is opened, where only turtlesim subscribes it.
    session = open_session("static")
    wishes = json.dumps({"topic": "/turtle1/cmd_vel"})
    assert texts_of(session, 1.0, wishes)["echo"]["topic"] == ""
    drive = json.dumps({"topic": "/turtle1/cmd_vel", "drive": [["turtle1", 2.0, 0.0]]})
    assert texts_of(session, 2.0, drive)["echo"]["topic"].startswith("linear:\n  x: 2.0")


def test_the_frames_are_told_with_every_step_while_they_are_drawn(open_session):
    session = open_session("listener")
    texts_of(session, 1.0)
    before = texts_of(session, 0.16, json.dumps({"axes": True, "drive": [["turtle1", 2.0, 0.0]]}))
    (text,) = session.step(1, '{"axes": true}')
    frames = json.loads(text)["frames"]
    assert frames.keys() == {"world", "turtle1", "turtle2"}
    assert frames["turtle1"][0] > before["axes"]["frames"]["turtle1"][0]
    assert session.step(1, "{}") == []


def test_commands_drive_turtle1(open_session):
    session = open_session("listener")
    scene = json.loads(session.step(1, "{}")[0])
    assert scene["turtles"] == ["turtle1", "turtle2"]
    (before, _), _ = poses_of(session.frame())
    session.step(10, json.dumps({"drive": [["turtle1", 2.0, 0.0]]}))
    (after, _), _ = poses_of(session.frame())
    assert after - before == pytest.approx(0.32, abs=0.05)


def test_the_doctor_reports_after_three_seconds(open_session):
    session = open_session("faults", faults=["wrong_frame"])
    session.step(100, "{}")
    session.examine()
    assert "doctor" not in texts_of(session, 2.0)
    assert "separate trees" in texts_of(session, 1.3)["doctor"]["text"]


def test_a_mistake_at_the_start_names_its_line(open_session):
    mistake = json.loads(open_session("listener", ("import math", "import maths")).mistake)
    assert (mistake["file"], mistake["line"]) == ("turtle_tf2_listener.py", 2)
    assert mistake["text"].startswith("ModuleNotFoundError: No module named 'maths'")


def test_a_mistake_in_a_callback_ends_the_session_and_names_its_line(open_session):
    session = open_session("listener", ("t.transform.translation.y,", "t.transform.position.y,"))
    assert session.mistake is None
    texts_of(session, 3.0)
    mistake = json.loads(session.mistake)
    assert mistake["line"] == 58
    assert "has no attribute 'position'" in mistake["text"]
    assert session.step(1, "{}") == []


@pytest.mark.parametrize(
    ("change", "text", "hint"),
    [
        (("rclpy.spin(node)", "pass"), "did not spin a node", "rclpy.spin"),
        (("rclpy.spin(node)", "rclpy.spin_once(node)"), "rclpy.spin_once cannot wait", "timer"),
        (("def main(", "def start("), "has no function main()", "main()"),
        (("rclpy.spin(node)", "raise SystemExit('no')"), "main() ended the program: no", "command"),
    ],
)
def test_invalid_main_is_reported(open_session, change, text, hint):
    changes = [change]
    if "start" in change[1]:
        changes.append(("    main()", "    start()"))
    mistake = json.loads(open_session("listener", *changes).mistake)
    assert text in mistake["text"]
    assert hint in mistake["hint"]


def test_an_interrupt_says_what_an_endless_loop_needs(open_session):
    session = open_session("listener", ("msg = Twist()", "raise KeyboardInterrupt"))
    texts_of(session, 3.0)
    mistake = json.loads(session.mistake)
    assert mistake["text"] == "Your code was stopped because it did not return."
    assert "timer" in mistake["hint"]


def test_the_classroom_takes_and_gives_texts():
    lesson = load_lesson(LESSONS / "static")
    files = json.dumps(lesson.solution())
    session = classroom.open_session("static", files, "[]")
    session.step(20, "{}")
    session.close()
    results = []
    classroom.grade("static", files, results.append, lambda: None)
    assert [json.loads(result)["passed"] for result in results] == [True] * 4


TAB = """
import sys, threading
sys.platform = "emscripten"
def start(self):
    raise RuntimeError("can't start new thread")
threading.Thread.start = start
sys.modules["numpy"] = sys.modules["turtlewire._native"] = None
sys.path.insert(0, {python!r})
import json
from pathlib import Path
from turtle_lesson.lesson import load_lesson
from turtle_lesson.session import LessonSession
import turtlewire.tf.buffer
from turtlewire.wire.environment import middleware_name
lesson = load_lesson(Path({lesson!r}))
session = LessonSession(lesson, lesson.starter())
assert session.mistake is None, session.mistake
for _ in range(50):
    texts = session.step(12, json.dumps(
        {{"target": "turtle2", "source": "turtle1", "topic": "/tf"}}))
session.examine()
for _ in range(20):
    session.step(12, "{{}}")
assert session.mistake is None, session.mistake
session.close()
print(turtlewire.tf.buffer.CORE, middleware_name())
"""


@pytest.mark.slow
def test_it_needs_no_thread_no_numpy_and_no_compiled_core():
    """As in a browser tab: what is missing there is taken away here."""
    code = TAB.format(python=str(LESSON_CODE), lesson=str(LESSONS / "listener"))
    done = run_python(code, check=False, timeout=110)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == ["python", "local"]
    assert "compiled core" not in done.stderr
