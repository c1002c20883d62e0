"""A context that is closed while threads are about to use the library."""

from __future__ import annotations

import contextlib
import threading
import traceback
from functools import partial

import pytest
import zenoh
from tests.needs import COMPILED_CORE

from turtlewire.errors import WireError
from turtlewire.tf.buffer import CORE
from turtlewire.wire import open_context
from turtlewire.wire.base import RequestId, ServiceTypes, TypeId
from turtlewire.wire.qos import QoS
from turtlewire.wire.zenoh.callback_threads import CallbackThreads, Calls

REQUEST = TypeId("std_srvs/srv/SetBool_Request", "RIHS01_" + "1" * 64)
RESPONSE = TypeId("std_srvs/srv/SetBool_Response", "RIHS01_" + "2" * 64)
SWITCH = ServiceTypes("std_srvs/srv/SetBool", REQUEST, RESPONSE, lambda _: "RIHS01_" + "3" * 64)

LONG = 60_000_000_000


def test_a_response_that_comes_too_late_lets_go_of_no_query():
    """The interpreter may be about to end: freeing a query then aborts the process."""
    context = open_context(middleware="rmw_zenoh_cpp")
    service = context.create_node("server").create_service("/switch", SWITCH, QoS(depth=5))
    asked, query = RequestId(1, 1), object()
    service._queries[asked] = query
    context._core.calls.close()
    with pytest.raises(WireError, match="the context is closed") as late:
        service.send_response(asked, bytes(8))
    seen = [frame.f_locals.values() for frame, _ in traceback.walk_tb(late.value.__traceback__)]
    assert all(value is not query for values in seen[1:] for value in values)
    assert service._queries.pop(asked) is query
    context.close()


def test_closing_waits_for_other_threads_alone():
    """A signal handler may close what its own thread is about to use."""
    calls = Calls()
    with calls:
        calls.close()
        calls.join()
    with pytest.raises(WireError, match="the context is closed"), calls:
        pass


def test_closing_waits_for_other_threads():
    calls, inside, leave = Calls(), threading.Event(), threading.Event()

    def call():
        with calls:
            inside.set()
            leave.wait(60)

    caller = threading.Thread(target=call)
    caller.start()
    assert inside.wait(60)
    calls.close()
    joined = threading.Thread(target=calls.join)
    joined.start()
    assert joined.is_alive()
    leave.set()
    joined.join(60)
    assert not joined.is_alive()
    caller.join(60)


def test_a_refused_declaration_starts_no_thread_to_wait_for():
    context, threads = open_context(middleware="rmw_zenoh_cpp"), CallbackThreads()
    session = context._core.session
    with pytest.raises(zenoh.ZError):  # before it starts the thread
        threads.declare(print, partial(session.declare_subscriber, "no#key"))
    session.close()
    with pytest.raises(zenoh.ZError):  # afterwards
        threads.declare(print, partial(session.declare_subscriber, "key"))
    end_on_a_thread(threads.join)
    end_on_a_thread(context.close)


def end_on_a_thread(end):
    ending = threading.Thread(target=end, daemon=True)
    ending.start()
    ending.join(60)
    assert not ending.is_alive()


class _Refusing:
    """A session that refuses tokens, or subscribers."""

    def __init__(self, session, refused):
        self._session, self._refused = session, refused

    def __getattr__(self, name):
        if name == self._refused:
            raise zenoh.ZError("refused")
        return getattr(self._session, name)


@pytest.mark.parametrize("refused", ["liveliness", "declare_subscriber"])
@pytest.mark.parametrize(
    "has_sink",
    [False, pytest.param(True, marks=pytest.mark.skipif(CORE != "native", reason=COMPILED_CORE))],
)
def test_an_endpoint_that_zenoh_refuses_leaves_nothing(refused: str, has_sink: bool):
    context = open_context(middleware="rmw_zenoh_cpp")
    node, core = context.create_node("node"), context._core
    session, core.session = core.session, _Refusing(core.session, refused)
    sink = None
    if has_sink:
        from turtlewire._native import Intake

        sink = Intake(False, 1, lambda *_: (b"", ""), int)
    with pytest.raises(WireError, match="create subscription /chatter: refused"):
        node.create_subscription("/chatter", KIND, QoS(), None, sink)
    core.session = session
    assert context.graph.endpoints() == []
    publisher = node.create_publisher("/chatter", KIND, QoS())
    assert publisher.subscription_count() == 0
    end_on_a_thread(context.close)


def test_a_node_that_zenoh_refuses_leaves_nothing():
    with contextlib.closing(open_context(middleware="rmw_zenoh_cpp")) as context:
        context._core.session.close()
        with pytest.raises(WireError, match="create node late: "):
            context.create_node("late")
        assert context.graph.nodes() == []


# A session that ends while something is declared in it.


KIND = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
TYPES = ServiceTypes("std_srvs/srv/SetBool", KIND, KIND, lambda _: "RIHS01_" + "1" * 64)


@pytest.mark.parametrize("what", ["publisher", "subscription", "client", "service"])
def test_declaration_rejected_by_zenoh_is_named(what: str):
    with contextlib.closing(open_context(middleware="rmw_zenoh_cpp")) as context:
        node = context.create_node("node")
        context._core.session.close()
        kind = KIND if what in ("publisher", "subscription") else TYPES
        with pytest.raises(WireError, match=f"create {what} /name: session closed"):
            getattr(node, f"create_{what}")("/name", kind, QoS())


def test_a_request_that_zenoh_refuses_is_an_error_of_the_wire():
    with contextlib.closing(open_context(middleware="rmw_zenoh_cpp")) as context:
        client = context.create_node("node").create_client("/name", TYPES, QoS())
        context._core.session.close()
        with pytest.raises(WireError, match="call /name: session closed"):
            client.send_request(bytes(8))


def test_requests_of_a_client_that_leaves_are_forgotten():
    with (
        contextlib.closing(open_context(middleware="rmw_zenoh_cpp")) as context,
        contextlib.closing(open_context(middleware="rmw_zenoh_cpp")) as callers,
    ):
        service = context.create_node("server").create_service("/switch", SWITCH, QoS(depth=9))
        node = callers.create_node("callers")
        clients = [node.create_client("/switch", SWITCH, QoS()) for _ in range(2)]
        wait_set = context.create_wait_set()
        wait_set.attach(service)
        for client in clients:
            assert callers.graph.wait_for(client.is_ready, LONG)
            client.send_request(bytes(8))
        requests = []
        while len(requests) < 2:
            assert wait_set.wait(LONG)
            requests += service.take()
        clients[0].close()
        assert context.graph.wait_for(lambda: len(service._queries) == 1, LONG)
        wait_set = callers.create_wait_set()
        wait_set.attach(clients[1])
        for request_id, _ in requests:
            service.send_response(request_id, bytes(8))
        assert wait_set.wait(LONG) == [clients[1]]
        assert service._queries == {}
