"""Calls that used to end the process silently inside Cyclone raise a clear error instead.

What Cyclone refuses in the middle leaves nothing behind.
"""

from __future__ import annotations

import os
import signal
import sys
from importlib.util import find_spec

import pytest
from tests.needs import COMPILED_CORE, needs_cyclone_dds
from tests.programs import run_python

from turtlewire.errors import WireError
from turtlewire.tf.buffer import CORE
from turtlewire.wire import open_context
from turtlewire.wire.base import Context, TypeId
from turtlewire.wire.qos import QoS

on_posix = pytest.mark.skipif(sys.platform == "win32", reason="limits and signals of POSIX")

OPEN = "from turtlewire.wire import open_context\nopen_context(5).close()\n"
LIMIT_S = 60
STRING = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
CYCLONE = "turtlewire.wire.cyclone"


def run(code: str, **environment: str):
    return run_python(code, check=False, timeout=LIMIT_S, env=os.environ | environment)


@on_posix
@needs_cyclone_dds
@pytest.mark.parametrize("more", [0, 1, 2, 3, 4, 6, 8, 12, 16, 20])
def test_few_files_left_is_one_clear_error(more: int):
    """Cyclone 11 crashes in ``dds_create_domain`` when it cannot open its sockets."""
    code = (
        "import os, resource\n"
        "from turtlewire.errors import WireError\n"
        "from turtlewire.wire import open_context\n"
        "import turtlewire.wire.cyclone.context\n"
        "used = max(map(int, os.listdir('/dev/fd')))\n"
        f"resource.setrlimit(resource.RLIMIT_NOFILE, (used + {more}, used + 99))\n"
        "try:\n"
        "    open_context(5)\n"
        "except WireError as error:\n"
        "    print(error, '|', error.hint)\n"
    )
    done = run(code)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("join domain 5: Too many open files")
    assert "ulimit -n" in done.stdout
    assert done.stderr == ""


@on_posix
@needs_cyclone_dds
def test_the_files_that_were_tried_are_free_again():
    code = (
        "import os\n"
        "from turtlewire.wire import open_context\n"
        "for _ in range(5):\n"
        "    open_context(5).close()\n"
        "    print(len(os.listdir('/dev/fd')))\n"
    )
    assert len(set(run(code).stdout.split())) == 1


@on_posix
@pytest.mark.skipif(CORE == "python", reason=COMPILED_CORE)
@pytest.mark.skipif(find_spec("cyclonedds") is None, reason="Cyclone DDS 0.10 does not abort")
def test_the_last_words_of_cyclone_survive_an_abort():
    peers = "<Discovery><Peers><Peer address='no.such.host.invalid'/></Peers></Discovery>"
    done = run(OPEN, CYCLONEDDS_URI=peers)
    assert done.returncode == -signal.SIGABRT
    assert "no.such.host.invalid" in done.stderr


@on_posix
@pytest.mark.skipif(CORE == "python", reason=COMPILED_CORE)
def test_an_abort_for_another_reason_ends_as_before():
    code = f"{OPEN}import faulthandler, os\nfaulthandler.enable()\nopen_context(5)\nos.abort()\n"
    done = run(code)
    assert done.returncode == -signal.SIGABRT
    assert done.stderr.count("Fatal Python error: Aborted") == 1


@pytest.mark.slow
@on_posix
@needs_cyclone_dds
def test_threads_that_still_call_survive_the_end_of_the_last_context():
    """Cyclone frees its tables with its last domain, whoever looks into them at that moment."""
    code = (
        "import sys, threading\n"
        "from turtlewire.wire import open_context\n"
        "from turtlewire.wire.cyclone import library as dds\n"
        "sys.setswitchinterval(1e-5)\n"
        "def use(wait_sets, begin, ended):\n"
        "    begin.wait()\n"
        "    while not ended.is_set():\n"
        "        for wait_set in wait_sets: wait_set.wake()\n"
        "        dds.delete(12345)\n"
        "for _ in range(100):\n"
        "    context, begin, ended = open_context(5), threading.Barrier(3), threading.Event()\n"
        "    uses = [context.create_wait_set() for _ in range(3)], begin, ended\n"
        "    threads = [threading.Thread(target=use, args=uses) for _ in range(2)]\n"
        "    for thread in threads: thread.start()\n"
        "    begin.wait()\n"
        "    context.close()\n"
        "    ended.set()\n"
        "    for thread in threads: thread.join()\n"
        "print('survived')\n"
    )
    done = run(code)
    assert (done.returncode, done.stdout) == (0, "survived\n"), done.stderr


def refuse(*_arguments):
    raise WireError("refused")


@needs_cyclone_dds
@pytest.mark.parametrize(
    "step",
    [
        "participant.dds.guid_of",
        "participant.Participant._check_types",
        "node.CycloneReaderThread",
        "node.Announcer",
    ],
)
def test_a_context_that_fails_leaves_its_domain(monkeypatch, step: str):
    from turtlewire.wire.cyclone.participant import _domains

    before = dict(_domains._users)
    with monkeypatch.context() as patched:
        patched.setattr(f"{CYCLONE}.{step}", refuse)
        with pytest.raises(WireError, match="refused"):
            open_context(77, middleware="rmw_cyclonedds_cpp")
    assert _domains._users == {**before, 77: 0}


@needs_cyclone_dds
def test_an_endpoint_that_fails_is_deleted(monkeypatch, context: Context):
    from turtlewire.wire.cyclone import library

    node = context.create_node("one")
    made, deleted = [], []
    make, delete = library.create_reader, library.delete
    monkeypatch.setattr(library, "create_reader", lambda *args: made.append(make(*args)) or made[0])
    monkeypatch.setattr(library, "delete", lambda handle: deleted.append(handle) or delete(handle))
    monkeypatch.setattr(library, "guid_of", refuse)
    with pytest.raises(WireError, match="refused"):
        node.create_subscription("/chatter", STRING, QoS())
    assert made[0] > 0
    assert made[0] in deleted


@needs_cyclone_dds
@pytest.mark.skipif(CORE != "native", reason=COMPILED_CORE)
@pytest.mark.parametrize("step", ["participant.Participant._create_topic", "library.guid_of"])
def test_the_way_to_a_sink_ends_with_its_subscription(monkeypatch, context: Context, step: str):
    from turtlewire._native import Intake
    from turtlewire.wire.cyclone.native import Inlet

    open_inlets, make, close = [], Inlet.__init__, Inlet.close
    monkeypatch.setattr(Inlet, "__init__", lambda *args: open_inlets.append(args[0]) or make(*args))
    monkeypatch.setattr(Inlet, "close", lambda inlet: open_inlets.remove(inlet) or close(inlet))
    node = context.create_node("one")
    monkeypatch.setattr(f"{CYCLONE}.{step}", refuse)
    with pytest.raises(WireError, match="refused"):
        node.create_subscription(
            "/chatter", STRING, QoS(), None, Intake(False, 1, lambda *_: (b"", ""), int)
        )
    assert open_inlets == []
