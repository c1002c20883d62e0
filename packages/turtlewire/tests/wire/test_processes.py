"""Two real processes over loopback."""

from __future__ import annotations

import os
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest
from tests.needs import needs_cyclone_dds

from turtlewire.wire import open_context
from turtlewire.wire.base import Context, ServiceTypes, TypeId
from turtlewire.wire.qos import Durability, QoS

ECHO = Path(__file__).parent / "peers" / "echo.py"
GIANT = Path(__file__).parent / "peers" / "giant.py"
STRING = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
REQUEST = TypeId("std_srvs/srv/SetBool_Request", "RIHS01_" + "1" * 64)
RESPONSE = TypeId("std_srvs/srv/SetBool_Response", "RIHS01_" + "2" * 64)
SWITCH = ServiceTypes("std_srvs/srv/SetBool", REQUEST, RESPONSE, lambda _: "RIHS01_" + "3" * 64)
LONG = 60_000_000_000
#: Python 3.12 and later warn that a process with threads forks.
QUIET_FORK = ("-W", "ignore:This process:DeprecationWarning")
#: For a peer that is missed after five minutes only, unless it says that it goes.
LONG_LEASE = {"CYCLONEDDS_URI": "<Discovery><LeaseDuration>300s</LeaseDuration></Discovery>"}


@pytest.fixture(params=["rmw_cyclonedds_cpp", "rmw_zenoh_cpp"])
def context(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", request.param)
    opened = open_context()
    yield opened
    opened.close()


@contextmanager
def echo_peer(**environment: str):
    peer = subprocess.Popen(
        [sys.executable, ECHO],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | environment,
    )
    try:
        assert peer.stdout is not None
        assert peer.stdout.readline() == "ready\n"
        yield peer
    finally:
        peer.communicate()
    assert peer.returncode in {0, -9}


def message(number: int) -> bytes:
    return b"\x00\x01\x00\x00" + number.to_bytes(4, "little") * 3


def take_all(context: Context, entity, count: int) -> list:
    wait_set = context.create_wait_set()
    wait_set.attach(entity)
    taken: list = []
    while len(taken) < count:
        assert wait_set.wait(LONG) == [entity]
        taken += entity.take()
    wait_set.close()
    return taken


def test_messages_go_both_ways(context: Context):
    node = context.create_node("here")
    publisher = node.create_publisher("/to_peer", STRING, QoS(depth=1000))
    subscription = node.create_subscription("/from_peer", STRING, QoS(depth=1000))
    with echo_peer():
        assert context.graph.wait_for(
            lambda: publisher.subscription_count() == 1 and subscription.publisher_count() == 1,
            LONG,
        )
        sent = [message(number) for number in range(300)]
        for data in sent:
            publisher.publish(data)
        assert [data for data, _ in take_all(context, subscription, len(sent))] == sent
    assert context.graph.wait_for(lambda: publisher.subscription_count() == 0, LONG)


def test_a_late_joiner_receives_the_latched_message(context: Context):
    with echo_peer():
        node = context.create_node("here")
        subscription = node.create_subscription(
            "/latched", STRING, QoS(depth=1, durability=Durability.TRANSIENT_LOCAL)
        )
        [(data, _)] = take_all(context, subscription, 1)
        assert data[8:14] == b"hello\x00"


def test_a_service_answers_across_processes(context: Context):
    client = context.create_node("here").create_client("/peer/service", SWITCH, QoS())
    with echo_peer():
        assert context.graph.wait_for(client.is_ready, LONG)
        for number in range(20):
            sequence_number = client.send_request(message(number))
            assert take_all(context, client, 1) == [(sequence_number, message(number))]
    assert context.graph.wait_for(lambda: not client.is_ready(), LONG)


def test_the_first_request_of_a_new_client_is_always_answered(context: Context):
    """The server may know of the request before it knows the client's end of the reply topic."""
    with echo_peer():
        for number in range(20):
            client = context.create_node(f"here{number}").create_client(
                "/peer/service", SWITCH, QoS()
            )
            assert context.graph.wait_for(client.is_ready, LONG)
            sequence_number = client.send_request(message(number))
            assert take_all(context, client, 1) == [(sequence_number, message(number))]
            client.close()


def test_a_killed_peer_disappears_after_its_lease(context: Context):
    with echo_peer(
        CYCLONEDDS_URI="<Discovery><LeaseDuration>1s</LeaseDuration></Discovery>"
    ) as peer:
        graph = context.graph
        assert graph.wait_for(lambda: [node.name for node in graph.nodes()] == ["echo"], LONG)
        assert graph.wait_for(lambda: "/latched" in graph.topic_names_and_types(), LONG)
        peer.kill()
        assert graph.wait_for(
            lambda: graph.nodes() == [] and "/latched" not in graph.topic_names_and_types(), LONG
        )


def test_a_peer_killed_in_the_middle_of_a_message_harms_nobody(context: Context):
    """Whole messages arrive, or none; and what others send arrives too."""
    subscription = context.create_node("here").create_subscription("/giant", STRING, QoS(depth=10))
    for _ in range(3):
        with subprocess.Popen([sys.executable, GIANT], stdout=subprocess.PIPE, text=True) as peer:
            assert peer.stdout is not None
            assert peer.stdout.readline() == "sending\n"
            peer.kill()
        assert peer.returncode == -9
    other = open_context()
    publisher = other.create_node("other").create_publisher("/giant", STRING, QoS())
    assert other.graph.wait_for(lambda: publisher.subscription_count() == 1, LONG)
    publisher.publish(message(7))
    sizes = []
    while len(message(7)) not in sizes:
        sizes += [len(data) for data, _ in take_all(context, subscription, 1)]
    assert set(sizes) <= {len(message(7)), 50_000_004}
    other.close()


def test_a_peer_that_leaves_is_gone_at_once(context: Context):
    graph = context.graph
    with echo_peer(**LONG_LEASE):
        assert graph.wait_for(lambda: len(graph.nodes()) == 1, LONG)
    assert graph.wait_for(lambda: graph.nodes() == [], LONG)


def test_a_process_that_forgets_to_close_ends_and_says_goodbye(context: Context):
    graph = context.graph
    code = (
        "from turtlewire.wire import open_context; open_context().create_node('forgetful'); input()"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code], stdin=subprocess.PIPE, text=True, env=os.environ | LONG_LEASE
    ) as process:
        assert graph.wait_for(lambda: len(graph.nodes()) == 1, LONG)
        process.communicate("\n", timeout=60)
    assert process.returncode == 0
    assert graph.wait_for(lambda: graph.nodes() == [], LONG)


def output(code: str, **environment: str) -> str:
    """Return what a program that forks prints; it must not warn or fail."""
    done = subprocess.run(
        [sys.executable, *QUIET_FORK, "-c", code],
        env=os.environ | environment,
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    assert done.stderr == ""
    return done.stdout


def test_a_forked_child_is_told_so_and_ends_quietly(context: Context):
    code = (
        "import os, warnings\n"
        "from turtlewire.wire import open_context\n"
        "context = open_context()\n"
        "if os.fork() == 0:\n"
        "    try:\n"
        "        context.create_node('child')\n"
        "    except Exception as error:\n"
        "        print(error, flush=True)\n"
        "else:\n"
        "    os.wait()\n"
    )
    refused = "create node child: the context was opened before this process was forked\n"
    assert output(code) == refused


@pytest.mark.parametrize("context", ["rmw_cyclonedds_cpp", "rmw_zenoh_cpp", "local"], indirect=True)
@pytest.mark.usefixtures("context")
def test_a_forked_child_may_close_what_it_inherits():
    code = (
        "import os, signal, threading\n"
        "from turtlewire.wire import open_context\n"
        "from turtlewire.wire.base import ServiceTypes, TypeId\n"
        "from turtlewire.wire.qos import QoS\n"
        "context, kind = open_context(), TypeId('std_msgs/msg/String', 'RIHS01_' + '0' * 64)\n"
        "types = ServiceTypes('std_srvs/srv/Empty', kind, kind, lambda _: kind.type_hash)\n"
        "node, wait_set = context.create_node('parent'), context.create_wait_set()\n"
        "ends = [node.create_publisher('/a', kind, QoS())]\n"
        "ends.append(node.create_client('/b', types, QoS()))\n"
        "ends.append(node.create_service('/b', types, QoS()))\n"
        "ends.append(node.create_subscription('/a', kind, QoS()))\n"
        "wait_set.attach(ends[-1])\n"
        "core = getattr(context, '_core', context)\n"
        "reader = getattr(core, 'reader', None) or context._reader\n"
        "locked = (*ends, wait_set, context, core, reader)\n"
        "locks = [getattr(each, name, None) for each in locked for name in ('lock', '_lock')]\n"
        "held, forked = threading.Event(), threading.Event()\n"
        "def hold():  # as another thread may at the moment of the fork\n"
        "    taken = [lock for lock in {id(each): each for each in locks if each}.values()]\n"
        "    for lock in taken:\n"
        "        lock.acquire()\n"
        "    held.set()\n"
        "    forked.wait(50)\n"
        "    for lock in taken:\n"
        "        lock.release()\n"
        "holder = threading.Thread(target=hold, daemon=True)\n"
        "holder.start()\n"
        "assert held.wait(20)\n"
        "if os.fork() == 0:\n"
        "    signal.alarm(20)\n"
        "    for entity in (*ends, wait_set, node, context):\n"
        "        entity.close()\n"
        "    context.call_soon(print)\n"
        "    print('closed', flush=True)\n"
        "    raise SystemExit\n"
        "os.wait()\n"
        "forked.set()\n"
        "holder.join()\n"
        "print(len(context.graph.nodes()))\n"
    )
    assert output(code, ROS_AUTOMATIC_DISCOVERY_RANGE="OFF") == "closed\n1\n"


def forked(before: str) -> str:
    """Return the output of a child that is forked after ``before`` and opens its own context."""
    code = (
        "import os\n"
        "from turtlewire.wire import open_context\n"
        f"{before}\n"
        "if os.fork() == 0:\n"
        "    try:\n"
        "        own = open_context()\n"
        "        own.create_node('child')\n"
        "        print([node.name for node in own.graph.nodes()], flush=True)\n"
        "        own.close()\n"
        "    except Exception as error:\n"
        "        print(error, flush=True)\n"
        "else:\n"
        "    os.wait()\n"
    )
    return output(code, ROS_AUTOMATIC_DISCOVERY_RANGE="OFF")


def test_a_forked_child_opens_a_context_only_where_the_parent_has_none(context: Context):
    """The middleware would wait forever for threads that the child does not have."""
    is_zenoh = os.environ["RMW_IMPLEMENTATION"] == "rmw_zenoh_cpp"
    refused = "open a context: this process was forked from one "
    opened = refused + ("that had opened a context\n" if is_zenoh else "with an open context\n")
    assert forked("context = open_context()") == opened
    # The threads of Zenoh outlive its sessions.
    assert forked("open_context().close()") == (opened if is_zenoh else "['child']\n")
    assert forked("") == "['child']\n"


def test_a_process_with_discovery_off_is_not_seen(context: Context):
    graph = context.graph
    with echo_peer(ROS_AUTOMATIC_DISCOVERY_RANGE="OFF"), echo_peer():
        assert graph.wait_for(
            lambda: len(graph.nodes()) == 1 and "/latched" in graph.topic_names_and_types(), LONG
        )
        assert (
            len([endpoint for endpoint in graph.endpoints() if endpoint.topic == "/latched"]) == 1
        )


@needs_cyclone_dds
def test_domains_do_not_see_each_other(context: Context, other_domain: int):
    other = open_context(other_domain, middleware="rmw_cyclonedds_cpp")
    other.create_node("elsewhere").create_publisher("/elsewhere", STRING, QoS())
    with echo_peer():
        graph = context.graph
        assert graph.wait_for(lambda: "/latched" in graph.topic_names_and_types(), LONG)
        assert "/elsewhere" not in graph.topic_names_and_types()
        assert [node.name for node in other.graph.nodes()] == ["elsewhere"]
    other.close()
