"""scripts/demo.

What it says, how it ends, and that its check notices when something that the demo lives on is
killed.
"""

import os
import re
import signal
import sys
from pathlib import Path

import pytest
from tests.needs import needs_cyclone_dds, only_first_is_fast
from tests.places import SCRIPTS, TOOLS

DEMO = TOOLS / "demo.py"
INTERRUPTIBLE = SCRIPTS / "interruptible"
HEADLESS = {"TURTLEWIRE_PORT": "0", "TURTLEWIRE_BROWSER": "0", "DISPLAY": "", "WAYLAND_DISPLAY": ""}
VICTIMS = {
    "turtle_tf2_broadcaster-2": "a broadcaster has stopped",
    "turtle_tf2_broadcaster-3": "a broadcaster has stopped",
    "turtle_tf2_listener-4": "no messages of the listener's commands to turtle2",
    "turtlesim_node-1": (
        "no messages of turtle[12]|a broadcaster has stopped|the transform between the turtles"
        "|the listener's commands"
    ),
}


def log_of(check):
    return Path(check.wait_for(r"what the processes say goes to (.*)$")[0][1])


def test_the_status_is_a_line_only_when_it_is_news(monkeypatch):
    monkeypatch.syspath_prepend(DEMO.parent)
    from demo import is_news

    waits, near, far = (
        "waiting for turtle2",
        *(f"turtle2 follows turtle1, {distance} m away" for distance in ("0.10", "2.00")),
    )
    assert is_news(waits, "", 0.0)
    assert is_news(far, waits, 1.0)
    assert not is_news(near, far, 9.9)
    assert is_news(near, far, 10.0)
    assert not is_news(near, near, 1000.0)


def is_running(pid):
    try:
        return Path("/proc", pid, "stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


@pytest.mark.parametrize("terminal", only_first_is_fast(True, False))
def test_the_demo_reports_and_ends_at_ctrl_c_with_all_its_processes(run, terminal):
    demo = run(sys.executable, DEMO, environment=HEADLESS, terminal=terminal)
    domain = os.environ["ROS_DOMAIN_ID"]
    demo.wait_for(rf"ROS domain {domain}, discovery range LOCALHOST \(this computer only")
    demo.wait_for(r"source \S+/\.venv/setup\.bash")
    demo.wait_for("ros2 run turtlesim turtle_teleop_key")
    demo.wait_for(r"The field is shown at http://127\.0\.0\.1:\d+/")
    demo.wait_for(r"\[demo\] turtle2 follows turtle1, \d+\.\d\d m away")
    if terminal:
        demo.type("\x03")
    else:
        os.kill(demo.process.pid, signal.SIGINT)
    assert demo.wait() == 0
    assert "Traceback" not in demo.text
    assert "SIGTERM" not in demo.text  # they were asked at once, and did not need a second word
    pids = re.findall(r"process started with pid \[(\d+)\]", demo.text)
    assert len(pids) == 4
    assert not any(is_running(pid) for pid in pids)


def test_the_demo_ends_by_itself(run):
    demo = run(sys.executable, DEMO, "--seconds", "0.5", environment=HEADLESS)
    assert demo.wait() == 0
    # On a busy machine the time may be over before the processes start. What they print at their
    # end is not shown.
    pids = re.findall(r"process started with pid \[(\d+)\]", demo.text)
    assert not any(is_running(pid) for pid in pids)
    assert demo.survivors() == []


@pytest.mark.parametrize(
    "words",
    [
        ["--seconds", "-1"],
        ["--seconds", "nan"],
        ["--seconds", "soon"],
        ["--check", "--seconds", "9"],
        ["-x"],
    ],
)
def test_words_that_make_no_sense(run, words):
    demo = run(sys.executable, DEMO, *words)
    assert demo.wait() == 2
    assert "usage: scripts/demo" in demo.text
    assert "Traceback" not in demo.text


def test_a_wrong_domain_is_told_with_its_remedy(run):
    demo = run(sys.executable, DEMO, environment={"ROS_DOMAIN_ID": "kitchen"})
    assert demo.wait() == 1
    said = [line for _, line in demo.lines]
    assert said[0].startswith("[demo] ROS_DOMAIN_ID is not")
    assert "export ROS_DOMAIN_ID=" in said[1]
    assert len(said) == 2


@pytest.mark.parametrize("words", [[], ["--check"]])
@pytest.mark.parametrize(
    "moment", ["begin", "Ctrl-C ends it|what the processes say goes to", "process started with pid"]
)
def test_ctrl_c_while_it_starts_is_one_line_and_leaves_nothing_behind(run, words, moment):
    if words and moment == "process started with pid":
        pytest.skip("--check shows nothing of what the processes print")
    command = [INTERRUPTIBLE, sys.executable, DEMO, *words]
    begin = ["sh", "-c", 'echo begin; exec "$@"', "sh"]
    demo = run(*begin, *command, environment=HEADLESS, terminal=True)
    demo.wait_for(moment)
    demo.type("\x03")
    # Bash that is interrupted before the first line of its script exits with 255.
    assert demo.wait() in {0, 1, 130, 255, 256 - signal.SIGINT}
    assert "Traceback" not in demo.text
    assert "\x1b[31m" not in demo.text  # red
    assert moment == "begin" or re.search("ended|failed: interrupted", demo.text)
    assert demo.survivors() == []


NOT_INSTALLED = """
import signal, threading
import demo_launch
from demo_launch import ENDING, Launch, interrupt

for signum in ENDING:
    signal.signal(signum, interrupt)
demo_launch.COMMAND = ("not_installed",)
try:
    Launch().start()
except FileNotFoundError as error:
    print(error.filename)
for thread in threading.enumerate():
    if thread.name == "launch-output":
        thread.join()
print(*(signal.getsignal(signum) is interrupt for signum in ENDING))
"""


def test_a_launch_that_cannot_be_started_restores_the_signals(run):
    environment = {"PYTHONPATH": str(DEMO.parent)}
    program = run(sys.executable, "-c", NOT_INSTALLED, environment=environment)
    assert program.wait() == 0, program.text
    command, handlers = program.text.splitlines()
    assert command.endswith("not_installed")
    assert handlers == "True True True"


DROPPED = """
import os, signal, threading, weakref
from demo_launch import ENDING, interrupt

class Module:
    pass

def callback(_):
    os.kill(os.getpid(), signal.SIGINT)
    for _ in range(1000):  # the handler runs in here
        pass

for signum in ENDING:
    signal.signal(signum, interrupt)
module = Module()
reference = weakref.ref(module, callback)
try:
    del module
    threading.Event().wait(300)
except KeyboardInterrupt:
    print("interrupted")
"""


def test_ctrl_c_in_a_callback_of_a_weak_reference_is_not_lost(run):
    """At the end of each import there is such a callback, and Python drops its exceptions."""
    program = run(sys.executable, "-c", DROPPED, environment={"PYTHONPATH": str(DEMO.parent)})
    assert program.wait() == 0
    assert [line for _, line in program.lines] == ["interrupted"]


@pytest.mark.parametrize("command", [[INTERRUPTIBLE], []], ids=["shell", "python"])
def test_not_even_sigkill_leaves_processes_behind(run, command):
    demo = run(*command, sys.executable, DEMO, environment=HEADLESS)
    demo.wait_for("turtle2 follows turtle1")  # from now on the processes have nothing to print
    demo.process.kill()
    demo.wait_for_survivors()


@pytest.mark.parametrize(
    "middleware", [pytest.param("rmw_cyclonedds_cpp", marks=needs_cyclone_dds), "rmw_zenoh_cpp"]
)
def test_a_second_demo_in_the_same_domain_is_warned(run, middleware):
    environment = HEADLESS | {"RMW_IMPLEMENTATION": middleware}
    first = run(sys.executable, DEMO, environment=environment)
    first.wait_for("Starting turtlesim with node name /sim")
    second = run(sys.executable, DEMO, environment=environment)
    domain = int(os.environ["ROS_DOMAIN_ID"])
    second.wait_for(
        f"another demo runs in ROS domain {domain}.*ROS_DOMAIN_ID={domain + 1} scripts/"
    )
    for demo in (second, first):
        os.kill(demo.process.pid, signal.SIGINT)
        assert demo.wait() == 0
    assert "another demo" not in first.text


@pytest.mark.parametrize(
    "victims",
    [["turtle_tf2_listener-4"], pytest.param([*VICTIMS], marks=pytest.mark.slow)],
    ids=["listener", "each"],
)
def test_it_fails_when_a_process_is_killed(run, victims):
    checks = {}
    for victim in victims:  # each is killed as soon as it runs; all of them end at the same time
        check = checks[victim] = run(sys.executable, DEMO, "--check")
        log = log_of(check)
        check.wait_for("turtle2 moves: driving", timeout=90)
        pid = re.search(rf"\[{victim}\]: process started with pid \[(\d+)\]", log.read_text())[1]
        os.kill(int(pid), signal.SIGKILL)
    for victim, check in checks.items():
        assert check.wait() == 1, check.text
        assert re.search(VICTIMS[victim], check.text), check.text
        assert re.search(r"final distance [\d.]+ m, \d+ lookups", check.text), check.text
        assert "Traceback" not in check.text
        for pid in re.findall(r"process started with pid \[(\d+)\]", log_of(check).read_text()):
            assert not is_running(pid), check.text
