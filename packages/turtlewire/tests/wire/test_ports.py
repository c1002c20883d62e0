"""Processes of this host are counted by their ports."""

import subprocess
import sys
import time

import pytest

from turtlewire.wire import environment, open_context
from turtlewire.wire.cyclone import ports
from turtlewire.wire.cyclone.ports import max_processes, process_of, processes_on_host

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="only Linux lists the bound ports")


PARTICIPANT = """
import sys
from turtlewire.wire import open_context
context = open_context()
context.create_node(sys.argv[1])
print("ready", flush=True)
sys.stdin.read()
context.close()
"""


@pytest.fixture
def participant():
    """Starts processes with a node each; they end when their input does."""
    processes = []

    def start(name):
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
        processes.append(subprocess.Popen([sys.executable, "-c", PARTICIPANT, name], **pipes))
        assert processes[-1].stdout.readline() == b"ready\n"
        return processes[-1]

    yield start
    for process in processes:
        process.communicate(timeout=60)


def test_processes_are_counted_while_they_are_there(participant):
    domain = environment.domain_id()
    before = processes_on_host(domain)
    process = participant("one")
    assert processes_on_host(domain) == before + 1
    participant("two")
    assert processes_on_host(domain) == before + 2
    process.communicate(timeout=60)
    assert processes_on_host(domain) == before + 1


def test_a_graph_is_complete_when_it_knows_all_processes(participant):
    names = {f"node{number}" for number in range(5)}
    for name in names:
        participant(name)
    context = open_context()
    try:
        deadline = time.monotonic() + 60
        while (
            not context.graph.is_complete()
        ):  # ports of other processes come and go without a change of the graph
            assert time.monotonic() < deadline
            time.sleep(0.01)
        assert names <= {info.name for info in context.graph.nodes()}
    finally:
        context.close()


def test_a_graph_is_complete_although_a_context_has_no_node():
    without_node, context = open_context(), open_context()
    try:
        assert context.graph.wait_for(context.graph.is_complete, 60_000_000_000)
        assert context.graph.nodes() == []
    finally:
        without_node.close()
        context.close()


def test_participants_of_one_process_are_told_apart_from_others():
    first, second = open_context(), open_context()
    assert process_of(first.gid) == process_of(second.gid)
    first.close()
    second.close()
    fast = bytes.fromhex("010f1234567800000000000000 0001c1".replace(" ", ""))
    assert process_of(fast) == fast[:12]


def test_nothing_is_counted_on_systems_without_counts(monkeypatch):
    def refuse(*_args, **_kwargs):
        raise FileNotFoundError

    monkeypatch.setattr("builtins.open", refuse)
    assert processes_on_host(7) is None


def test_a_kernel_without_ipv6_still_counts(monkeypatch, participant):
    def open_ipv4(path, *args, **options):
        if path.endswith("udp6"):
            raise FileNotFoundError
        return open(path, *args, **options)

    domain = environment.domain_id()
    before = processes_on_host(domain)
    participant("one")
    monkeypatch.setattr(ports, "open", open_ipv4, raising=False)
    assert processes_on_host(domain) == before + 1


def test_each_domain_holds_120_processes_but_the_last_one():
    assert [max_processes(domain_id) for domain_id in (0, 7, 231, 232)] == [120, 120, 120, 62]
