"""A node's view of the graph, on both middlewares."""

import math
import threading
from functools import partial

import pytest

from rclpy._rclpy_pybind11 import NodeNameNonExistentError, RCLError
from rclpy.context import Context
from rclpy.endpoint_info import EndpointTypeEnum
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.topic_endpoint_info import TopicEndpointTypeEnum
from std_msgs.msg import Int32, String
from std_srvs.srv import Trigger


@pytest.fixture(params=["local", "rmw_cyclonedds_cpp"])
def middleware(request, monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", request.param)
    return request.param


@pytest.fixture
def other(middleware):
    """A node in another participant, `/ns/other`, with one endpoint of each kind."""
    with Context() as context:
        other = Node("other", namespace="/ns", context=context, start_parameter_services=False)
        other.create_publisher(
            Int32, "number", QoSProfile(depth=3, reliability=ReliabilityPolicy.BEST_EFFORT)
        )
        other.create_subscription(String, "/chatter", lambda _: None, 10)
        other.create_service(Trigger, "serve", lambda request, response: response)
        other.create_client(Trigger, "ask")
        yield other
        other.destroy_node()


@pytest.fixture
def wait_for(context):
    def wait(predicate):
        assert context.wait_for_graph(predicate, 60_000_000_000)

    return wait


def test_nodes(node, other):
    assert node.wait_for_node("/ns/other", 60)
    assert {"tested", "other"} <= set(node.get_node_names())
    assert {"/tested", "/ns/other"} <= set(node.get_fully_qualified_node_names())
    assert {("tested", "/"), ("other", "/ns")} <= set(node.get_node_names_and_namespaces())
    assert ("other", "/ns", "/") in node.get_node_names_and_namespaces_with_enclaves()


def test_wait_for_node_ends_when_it_comes_goes_or_the_time_is_over(context, node, middleware):
    assert not node.wait_for_node("/late", 0)
    assert not node.wait_for_node("/late", 0.05)
    assert not node.wait_for_node("/late", -0.5)
    made = []
    coming = threading.Timer(0.05, lambda: made.append(Node("late", context=context)))
    coming.start()
    assert node.wait_for_node("late", math.inf)
    coming.join()
    made[0].destroy_node()
    assert not node.wait_for_node("/late", 0)


def test_topics_and_services(node, other, wait_for):
    wait_for(lambda: {"/ns/number", "/chatter"} <= set(dict(node.get_topic_names_and_types())))
    topics = dict(node.get_topic_names_and_types())
    assert topics["/ns/number"] == ["std_msgs/msg/Int32"]
    assert topics["/chatter"] == ["std_msgs/msg/String"]
    assert not any(topic.startswith(("rq/", "rr/")) for topic in topics)
    raw = dict(node.get_topic_names_and_types(no_demangle=True))
    assert raw["rt/ns/number"] == ["std_msgs::msg::dds_::Int32_"]
    wait_for(lambda: {"/ns/serve", "/ns/ask"} <= set(dict(node.get_service_names_and_types())))
    assert dict(node.get_service_names_and_types())["/ns/serve"] == ["std_srvs/srv/Trigger"]


def test_by_node(node, other, wait_for):
    expected = {
        "publisher": ("/ns/number", ["std_msgs/msg/Int32"]),
        "subscriber": ("/chatter", ["std_msgs/msg/String"]),
        "service": ("/ns/serve", ["std_srvs/srv/Trigger"]),
        "client": ("/ns/ask", ["std_srvs/srv/Trigger"]),
    }

    def found(kind):
        try:
            return getattr(node, f"get_{kind}_names_and_types_by_node")("other", "/ns")
        except NodeNameNonExistentError:
            return []

    wait_for(lambda: all(expected[kind] in found(kind) for kind in expected))
    for kind in ("subscriber", "client"):  # the others of the node are built in
        assert found(kind) == [expected[kind]]
    assert "rt/ns/number" in dict(
        node.get_publisher_names_and_types_by_node("other", "/ns", no_demangle=True)
    )


@pytest.mark.parametrize("kind", ["publisher", "subscriber", "service", "client"])
def test_a_node_that_is_not_there(node, kind):
    query = getattr(node, f"get_{kind}_names_and_types_by_node")
    with pytest.raises(NodeNameNonExistentError, match="for nonexistent node") as raised:
        query("nobody", "/")
    assert "No node /nobody is known" in str(raised.value.hint)


def test_counts(node, other, wait_for):
    wait_for(
        lambda: node.count_publishers("/ns/number") == 1 and node.count_subscribers("chatter") == 1
    )
    wait_for(lambda: node.count_services("/ns/serve") == 1 and node.count_clients("/ns/ask") == 1)
    assert node.count_publishers("chatter") == 0
    assert node.count_services("/ns/ask") == 0


@pytest.mark.parametrize("name", ["not valid", "42", "", "{unknown}"])
def test_an_impossible_name_is_a_value_error(node, name):
    for ask in (
        node.count_publishers,
        node.count_subscribers,
        node.count_clients,
        node.count_services,
        node.get_publishers_info_by_topic,
        node.get_subscriptions_info_by_topic,
        node.get_clients_info_by_service,
        node.get_servers_info_by_service,
    ):
        with pytest.raises(ValueError, match="is invalid"):
            ask(name)


def test_own_endpoints_are_counted_from_the_first_moment(node):
    def counts(name):
        return node.count_publishers(name), node.count_subscribers(name)

    for number in range(50):
        name = f"topic{number}"
        publisher = node.create_publisher(String, name, 1)
        subscription = node.create_subscription(String, name, print, 1)
        assert counts(name) == (1, 1)
        (info,) = node.get_publishers_info_by_topic(name)
        assert info.node_name == node.get_name()
        publisher.destroy()
        subscription.destroy()
        assert counts(name) == (0, 0)


def test_a_thread_that_waits_hears_of_what_another_has_asked_about(node):
    """News that a question takes from the middleware also reaches the listeners."""
    heard = threading.Event()
    remove = node.context.wire.graph.add_listener(heard.set)
    for number in range(20):
        heard.clear()
        publisher = node.create_publisher(String, f"topic{number}", 1)
        assert node.count_publishers(f"topic{number}") == 1
        assert heard.wait(60)
        publisher.destroy()
    remove()


def test_endpoint_infos(node, other, wait_for):
    def claimed():
        infos = node.get_publishers_info_by_topic("/ns/number")
        return len(infos) == 1 and infos[0].node_name == "other"

    wait_for(claimed)
    (info,) = node.get_publishers_info_by_topic("/ns/number")
    assert (info.node_name, info.node_namespace, info.topic_type) == (
        "other",
        "/ns",
        "std_msgs/msg/Int32",
    )
    assert info.endpoint_type == TopicEndpointTypeEnum.PUBLISHER
    assert info.qos_profile.reliability == ReliabilityPolicy.BEST_EFFORT
    assert len(info.endpoint_gid) == 16
    assert (
        str(info.topic_type_hash)
        == "RIHS01_b6578ded3c58c626cfe8d1a6fb6e04f706f97e9f03d2727c9ff4e74b1cef0deb"
    )
    wait_for(lambda: len(node.get_subscriptions_info_by_topic("/chatter")) == 1)
    assert len(node.get_publishers_info_by_topic("rt/ns/number", no_mangle=True)) == 1
    assert node.get_subscriptions_info_by_topic("/ns/number") == []


def test_service_infos(node, other, wait_for):
    """Of two clients in one node, each has its own reader and writer."""
    other.create_client(Trigger, "ask")
    servers = partial(node.get_servers_info_by_service, "/ns/serve")
    clients = partial(node.get_clients_info_by_service, "/ns/ask")

    def known():
        nodes = [info.node_name for info in (*servers(), *clients())]
        return nodes == ["other"] * 3

    wait_for(known)
    (server,) = servers()
    assert (server.node_namespace, server.service_type) == ("/ns", "std_srvs/srv/Trigger")
    assert (server.endpoint_type, server.endpoint_count) == (EndpointTypeEnum.SERVER, 2)
    assert str(server.service_type_hash) == "INVALID"  # Jazzy's endpoints do not announce it
    assert [qos.reliability for qos in server.qos_profiles] == [ReliabilityPolicy.RELIABLE] * 2
    (reader,) = other.context.wire.graph.endpoints_of("rq/ns/serveRequest", "subscription")
    (writer,) = other.context.wire.graph.endpoints_of("rr/ns/serveReply", "publisher")
    assert server.endpoint_gids == [list(reader.gid), list(writer.gid)]
    own = {client._wire.replies.gid: client._wire.requests.gid for client in other.clients}
    assert {bytes(info.endpoint_gids[0]): bytes(info.endpoint_gids[1]) for info in clients()} == own
    assert {info.endpoint_type for info in clients()} == {EndpointTypeEnum.CLIENT}
    assert node.get_clients_info_by_service("/ns/serve") == []
    assert node.get_servers_info_by_service("/ns/ask") == []


def test_service_infos_are_of_the_remapped_name(context, wait_for):
    arguments = ["--ros-args", "-r", "serve:=/elsewhere"]
    node = Node("remapped", context=context, cli_args=arguments)
    node.create_service(Trigger, "serve", lambda request, response: response)
    wait_for(lambda: len(node.get_servers_info_by_service("serve")) == 1)
    assert len(node.get_servers_info_by_service("/elsewhere")) == 1


def test_names_on_the_wire_are_no_services(node):
    for ask in (node.get_clients_info_by_service, node.get_servers_info_by_service):
        with pytest.raises(RCLError, match="no_mangle is not supported") as caught:
            ask("serve", no_mangle=True)
        assert "'rqserveRequest'" in caught.value.hint


def test_removed_items_are_forgotten(node, other, wait_for):
    wait_for(lambda: node.count_publishers("/ns/number") == 1)
    other.destroy_node()
    wait_for(
        lambda: node.count_publishers("/ns/number") == 0 and "other" not in node.get_node_names()
    )


def test_an_invalid_context_is_not_asked(context, node):
    context.shutdown()
    with pytest.raises(RCLError, match="rcl node's context is invalid"):
        node.get_topic_names_and_types()
    with pytest.raises(RCLError, match="rcl node's context is invalid"):
        node.count_publishers("/topic")
