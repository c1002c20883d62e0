"""Calls that used to end the process silently inside Cyclone raise a clear error instead."""

from __future__ import annotations

import os
import signal
import sys
from importlib.util import find_spec

import pytest
from tests.needs import COMPILED_CORE, needs_cyclone_dds
from tests.programs import run_python

from turtlewire.tf.buffer import CORE

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="limits and signals of POSIX")

OPEN = "from turtlewire.wire import open_context\nopen_context(5).close()\n"
LIMIT_S = 60


def run(code: str, **environment: str):
    return run_python(code, check=False, timeout=LIMIT_S, env=os.environ | environment)


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


@pytest.mark.skipif(CORE == "python", reason=COMPILED_CORE)
@pytest.mark.skipif(find_spec("cyclonedds") is None, reason="Cyclone DDS 0.10 does not abort")
def test_the_last_words_of_cyclone_survive_an_abort():
    peers = "<Discovery><Peers><Peer address='no.such.host.invalid'/></Peers></Discovery>"
    done = run(OPEN, CYCLONEDDS_URI=peers)
    assert done.returncode == -signal.SIGABRT
    assert "no.such.host.invalid" in done.stderr


@pytest.mark.skipif(CORE == "python", reason=COMPILED_CORE)
def test_an_abort_for_another_reason_ends_as_before():
    code = f"{OPEN}import faulthandler, os\nfaulthandler.enable()\nopen_context(5)\nos.abort()\n"
    done = run(code)
    assert done.returncode == -signal.SIGABRT
    assert done.stderr.count("Fatal Python error: Aborted") == 1


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
