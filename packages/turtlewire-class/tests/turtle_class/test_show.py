"""The class on a page: its roster, and the state of each domain, all of it escaped."""

import contextlib
import itertools
import os
import re
import signal
import subprocess
import threading

import pytest
from tests.needs import only_first_is_fast
from tests.places import TURTLEWIRE

from turtle_class import ClassError
from turtle_class.domain_watch import DomainWatch
from turtle_class.roster import Seat, read_roster, seats_of_domains
from turtle_class.show import ClassPage
from turtlewire import msg
from turtlewire.testing import reserved_domain
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS

TF = "tf2_msgs/msg/TFMessage"
POSE = "turtlesim/msg/Pose"
LIMIT_MS = 60_000
EVIL = "evil\x1b[2J<img src=x onerror=alert(1)>"


class Student:
    """Nodes in a domain, as a student's programs make them."""

    def __init__(self, domain):
        self.context = open_context(domain)

    def node(self, name):
        return self.context.create_node(name)

    def turtle(self, node, topic="/turtle1/pose"):
        kind = TypeId(POSE, msg.type_hash(POSE))
        return node.create_publisher(topic, kind, QoS(depth=1))


@pytest.fixture
def domains():
    with contextlib.ExitStack() as stack:
        yield [stack.enter_context(reserved_domain()) for _ in range(2)]


@pytest.fixture
def student(domains):
    with contextlib.ExitStack() as stack:

        def student(number=0):
            made = Student(domains[number])
            stack.callback(made.context.close)
            return made

        yield student


@pytest.fixture
def watch(domains):
    with contextlib.closing(DomainWatch(Seat("Ana", domains[0]))) as watch:
        yield watch


def picture_when(watch, condition, act=lambda: None):
    """The first picture for which a condition holds."""
    pause = threading.Event()
    for _ in range(600):
        act()
        picture = watch.picture(fresh=True)
        if condition(picture):
            return picture
        pause.wait(0.1)
    raise AssertionError(picture)


def test_an_empty_domain(watch):
    picture = watch.picture(fresh=True)
    assert (picture["name"], picture["count"], picture["turtles"]) == ("Ana", 0, [])
    assert picture["problem"] is None
    assert picture["idle"] is None


def test_nodes_and_turtles_come_and_go(watch, student):
    ana = student()
    node = ana.node("turtlesim")
    publisher = ana.turtle(node)
    pose = msg.get_message(POSE)(x=3.0, y=4.0, theta=1.5)
    picture = picture_when(
        watch, lambda picture: picture["turtles"], lambda: publisher.publish(msg.serialize(pose))
    )
    assert picture["nodes"] == ["/turtlesim"]
    assert picture["turtles"] == [["turtle1", 3.0, 4.0, 1.5]]
    assert picture["idle"] is not None
    node.close()
    assert picture_when(watch, lambda picture: not picture["count"])["turtles"] == []


def test_poses_that_are_none_are_left_out(watch, student):
    ana = student()
    publisher = ana.turtle(ana.node("turtlesim"))
    other = ana.turtle(ana.node("second"), "/turtle2/pose")
    kind = msg.get_message(POSE)

    def send():
        publisher.publish(msg.serialize(kind(x=float("nan"))))
        publisher.publish(b"\0\1\0\0" + bytes(4))
        other.publish(msg.serialize(kind(x=1.0)))

    picture = picture_when(watch, lambda picture: picture["turtles"], send)
    assert [name for name, *_ in picture["turtles"]] == ["turtle2"]


def test_two_students_with_one_domain_are_told_so(watch, student):
    for each in (student(), student()):
        each.node("turtlesim")
    picture_when(watch, lambda picture: picture["count"] == 2)
    watch.examine(threading.Event(), 0.1)
    problem = watch.picture(fresh=True)["problem"]
    assert problem["bad"]
    assert problem["text"] == "2 nodes have the same name /turtlesim."
    assert "two students use ROS_DOMAIN_ID=" in problem["remedy"]


def test_names_are_escaped_and_cut_and_counted(watch, student):
    ana = student()
    for name in (EVIL, "a" * 200, *(f"n{number}" for number in range(40))):
        ana.node(name)
    picture = picture_when(watch, lambda picture: picture["count"] == 42)
    assert len(picture["nodes"]) == 20
    assert all(name.isprintable() and len(name) <= 81 for name in picture["nodes"])
    assert "/evil\\x1b[2J<img src=x onerror=alert(1)>" in picture["nodes"]


def test_a_flood_of_frames_is_not_kept(watch, student):
    ana = student()
    node = ana.node("broadcaster")
    publisher = node.create_publisher("/tf", TypeId(TF, msg.type_hash(TF)), QoS(depth=100))
    numbers = itertools.count()

    def send():
        message = msg.get_message(TF)()
        for number in itertools.islice(numbers, 60):
            transform = msg.get_message("geometry_msgs/msg/TransformStamped")()
            transform.header.frame_id, transform.child_frame_id = "world", f"frame{number}"
            transform.transform.rotation.w = 1.0
            message.transforms.append(transform)
        publisher.publish(msg.serialize(message))

    picture_when(watch, lambda picture: picture["problem"] is not None, send)
    picture = watch.picture(fresh=True)
    assert picture["problem"]["text"].startswith("More than 500 frames")
    assert picture["frames"] is None
    sent = next(numbers)
    for _ in range(20):
        send()
    assert next(numbers) > sent + 1000
    assert watch.picture(fresh=True)["frames"] is None
    node.close()
    ana.node("mended")
    picture = picture_when(watch, lambda picture: picture["nodes"] == ["/mended"])
    assert picture["problem"] is None


def test_without_a_looker_transforms_are_left_alone(watch, student):
    ana = student()
    ana.node("broadcaster")
    picture_when(watch, lambda picture: picture["count"] == 1)
    graph = ana.context.graph
    assert graph.wait_for(lambda: tf_readers(graph), 60_000_000_000)
    watch.rest()
    assert graph.wait_for(lambda: not tf_readers(graph), 60_000_000_000)
    watch.picture(fresh=True)
    assert graph.wait_for(lambda: tf_readers(graph), 60_000_000_000)


def tf_readers(graph):
    return [end for end in graph.endpoints() if end.kind == "subscription" and end.topic == "/tf"]


@pytest.fixture
def page(domains):
    seats = [Seat("<b>Ana</b>", domains[0]), Seat("Björn", domains[1])]
    with contextlib.closing(ClassPage(seats, port=0)) as page:
        yield page


@pytest.mark.slow
def test_the_page_in_a_browser(page, student, browser):
    from playwright.sync_api import expect

    ana = student()
    publisher = ana.turtle(ana.node(EVIL))
    publisher.publish(msg.serialize(msg.get_message(POSE)(x=3.0, y=4.0)))
    with contextlib.closing(browser.new_context(bypass_csp=True)) as context:
        tab = context.new_page()
        tab.set_default_timeout(LIMIT_MS)
        errors = []
        tab.on("pageerror", lambda error: errors.append(str(error)))
        tab.on("dialog", lambda dialog: errors.append(dialog.message))
        tab.goto(page.url)
        tab.wait_for_function("() => document.querySelectorAll('article').length === 2")
        tab.wait_for_function("() => document.querySelector('.nodes').textContent.includes('evil')")
        assert tab.locator("h2").all_text_contents() == ["<b>Ana</b>", "Björn"]
        assert tab.locator("img").count() == 0
        expect(tab.locator("#summary")).to_contain_text("1 running", timeout=LIMIT_MS)
        tab.wait_for_function("() => document.querySelector('article.note, article.bad') !== null")
        tab.fill("#filter", "björn")
        tab.wait_for_function("() => document.querySelectorAll('article').length === 1")
        tab.fill("#filter", "nobody")
        tab.wait_for_selector("#nothing:not([hidden])")
        tab.fill("#filter", "")
        tab.select_option("#sort", "bad")
        tab.select_option("#show", "off")
        tab.wait_for_function("() => document.querySelectorAll('article.off').length === 1")
        tab.select_option("#size", "l")
        assert tab.evaluate("document.body.dataset.size") == "l"
    assert errors == []


def command(*words):
    return subprocess.Popen(
        [TURTLEWIRE, "class", *words],
        env={**os.environ, "TURTLEWIRE_BROWSER": "0"},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


@pytest.mark.parametrize("number", only_first_is_fast(signal.SIGINT, signal.SIGTERM))
def test_the_command_ends_at_once(domains, number):
    low, high = sorted(domains)
    with command("--domains", f"{low},{high}", "--port", "0", "--lan") as program:
        line = program.stdout.readline()
        assert re.fullmatch(r"The class of 2 is at http://127\.0\.0\.1:\d+/\w+/ \(.*\)\n", line)
        program.send_signal(number)
        _, err = program.communicate(timeout=60)
    assert program.returncode == (130 if number == signal.SIGINT else 0)
    assert "Traceback" not in err


def test_wrong_domains_are_answered():
    with command("--domains", "1-999") as program:
        _, err = program.communicate(timeout=60)
    assert program.returncode == 2
    assert err.startswith("turtlewire class: '1-999' names no domains: a domain is a number from 0")


# The roster: ranges of domains, and files.


@pytest.mark.parametrize(
    ("text", "domains"), [("0", [0]), ("232", [232]), ("231-232", [231, 232]), ("5-5", [5])]
)
def test_the_first_and_the_last_domain(text, domains):
    assert [seat.domain for seat in seats_of_domains(text)] == domains


def test_domains():
    seats = seats_of_domains("1-3, 40")
    assert [seat.domain for seat in seats] == [1, 2, 3, 40]
    assert seats[0].name == "Domain 1"


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "write them as 1-30"),
        ("a", "'a' names no domains: write them as 1-30"),
        ("5-3", "the smaller one first"),
        ("1-233", "from 0 to 232"),
        ("1-3,3", "domain 3 belongs to"),
        ("-1", "'-1' names no domains"),
    ],
)
def test_invalid_domains(text, told):
    with pytest.raises(ClassError, match=told):
        seats_of_domains(text)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.csv", "name,domain\n# comment\nAna Müller, 1\n\nBjörn,2\n"),
        ("a.csv", '\ufeff"Ana Müller",1\r\nBjörn,2\r\n'),
        ("a.yaml", "# comment\nAna Müller: 1\nBjörn: 2\n"),
    ],
)
def test_a_roster(tmp_path, name, text):
    (tmp_path / name).write_text(text, encoding="utf-8")
    assert read_roster(tmp_path / name) == [Seat("Ana Müller", 1), Seat("Björn", 2)]


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("a.csv", "Ana,1\nBjörn\n", r"a\.csv, line 2: 'Björn': write a line"),
        ("a.csv", "Ana,one\n", r"a\.csv, line 1: 'one' is not a domain of Ana"),
        ("a.csv", "Ana,1\nBjörn,999\n", r"line 2: '999' is not a domain of Björn: .* 0 to 232"),
        ("a.csv", ",1\n", "line 1: the name is missing"),
        ("a.csv", "Ana,1\nBjörn,1\n", "line 2: domain 1 belongs to Ana and Björn"),
        ("a.csv", "\n", "holds no students"),
        ("a.yaml", "Ana: 1\nBjörn: [2]\n", r"a\.yaml, line 2: write a line"),
        ("a.yaml", "- Ana\n", r"a\.yaml, line 1: write a line"),
        ("a.yaml", "Ana: {", r"a\.yaml is not YAML"),
        ("a.yaml", "[" * 30_000, r"a\.yaml is nested too deeply"),
        ("a.csv", f"Ana,{'1' * 9_000}\n", r"line 1: '1{9000}' is not a domain of Ana"),
        ("a.csv", f'Ana,"{"x" * 200_000}"\n', r"a\.csv is not CSV: field larger"),
        ("a.csv", "\x1b[2J,x\n", r"not a domain of \\x1b\[2J"),
    ],
)
def test_a_wrong_roster(tmp_path, name, text, told):
    (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(ClassError, match=told):
        read_roster(tmp_path / name)


def test_a_roster_that_is_not_there(tmp_path):
    with pytest.raises(ClassError, match=r"the roster none\.csv cannot be read: No such file"):
        read_roster(tmp_path / "none.csv")


def test_a_roster_in_another_encoding(tmp_path):
    (tmp_path / "old.csv").write_bytes("Björn,2\n".encode("latin-1"))
    with pytest.raises(ClassError, match=r"^the roster old\.csv is not UTF-8: save it as UTF-8$"):
        read_roster(tmp_path / "old.csv")
