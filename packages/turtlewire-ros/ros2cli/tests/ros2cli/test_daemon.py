"""The daemon: it answers programs, is started and stopped, and ends by itself."""

import argparse
import functools
import http.client
import pickle
import signal
import socket
import subprocess
import sys
import threading
import xmlrpc.client
from contextlib import suppress

import pytest

import rclpy
from rclpy.duration import Duration
from rclpy.endpoint_info import EndpointTypeEnum, ServiceEndpointInfo, TopicEndpointInfo
from rclpy.qos import QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
from rclpy.type_hash import TypeHash
from ros2cli import daemon
from ros2cli.daemon import daemonize
from ros2cli.helpers import wait_for
from ros2cli.main import main
from ros2cli.node import network_aware
from ros2cli.node.daemon import DaemonNode, is_daemon_running, shutdown_daemon, spawn_daemon
from ros2cli.node.direct import DirectNode
from ros2cli.node.strategy import NodeStrategy
from ros2cli.xmlrpc.marshal.generic import fullname
from ros2cli.xmlrpc.marshal.rclpy import policy_types

PROGRAM = "import sys; from ros2cli.daemon import main; sys.exit(main())"


@pytest.fixture
def running():
    assert spawn_daemon(None, timeout=60)
    yield
    shutdown_daemon(None, timeout=60)


def test_the_verbs(capsys):
    told = []
    for verb in ("status", "stop", "start", "status", "start", "stop", "start", "stop", "status"):
        assert main(["daemon", verb]) == 0
        told.append(capsys.readouterr().out.removeprefix("The daemon ").rstrip())
    assert told == [
        "is not running",
        "is not running",
        "has been started",
        "is running",
        "is already running",
        "has been stopped",
        "has been started",  # at once after another one
        "has been stopped",
        "is not running",
    ]


@pytest.mark.usefixtures("running")
def test_it_answers_as_a_node_does():
    with NodeStrategy(None) as strategy, NodeStrategy(argparse.Namespace(no_daemon=True)) as direct:
        assert isinstance(strategy.daemon_node, DaemonNode)
        assert direct.daemon_node is None
        # Both see the nodes of both.
        (name,) = [
            name
            for name, _ in direct.get_node_names_and_namespaces()
            if name.startswith(f"_ros2cli_daemon_{daemon.get_ros_domain_id()}_")
        ]
        assert strategy.get_name() == name
        own = direct.node.get_name()
        ask = strategy.get_publishers_info_by_topic
        seen = functools.partial(ask, "/rosout")
        assert wait_for(lambda: {info.node_name for info in seen()} == {name, own}, timeout=60)
        theirs = direct.get_publishers_info_by_topic("/rosout")
        assert sorted(map(str, ask("/rosout"))) == sorted(map(str, theirs))
        assert all(isinstance(info.qos_profile, QoSProfile) for info in ask("/rosout"))
        assert [own, "/"] in strategy.get_node_names_and_namespaces()
        assert strategy.count_publishers("/rosout") == 2


@pytest.mark.usefixtures("running")
def test_a_node_has_what_the_daemon_does_not_offer():
    with NodeStrategy(None) as strategy:
        assert "get_parameter" not in strategy.daemon_node.methods
        assert strategy.get_parameter("use_sim_time").value is False
        assert strategy.direct_node.node.get_name() != strategy.get_name()


@pytest.mark.usefixtures("running")
def test_any_program_may_ask_but_no_web_page():
    with xmlrpc.client.ServerProxy(daemon.get_xmlrpc_server_url()) as proxy:
        topics = dict(proxy.get_topic_names_and_types())
        assert topics["/rosout"] == ["rcl_interfaces/msg/Log"]
        assert "get_topic_names_and_types" in proxy.system.listMethods()
    call = xmlrpc.client.dumps((), "get_name")
    for path, headers, status in (
        ("/ros2cli/", {}, 200),
        ("/ros2cli/", {"Origin": "http://example.org"}, 403),
        ("/", {}, 404),
    ):
        connection = http.client.HTTPConnection(*daemon.get_address())
        connection.request("POST", path, call, {"Content-Type": "text/plain", **headers})
        assert connection.getresponse().status == status
        connection.close()


@pytest.mark.usefixtures("running")
def test_only_one_runs_in_a_domain(capsys):
    assert not spawn_daemon(None)
    assert daemon.main(argv=[]).startswith(f"Cannot serve on {daemon.get_xmlrpc_server_url()}: ")


def test_it_ends_when_nobody_asks():
    words = [sys.executable, "-c", PROGRAM, "--timeout", "0"]
    done = subprocess.run(words, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
    url = daemon.get_xmlrpc_server_url()
    assert done.stdout == f"Serving XML-RPC on {url}\nShutdown due to timeout\n"


def test_it_ends_at_a_signal():
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    with subprocess.Popen([sys.executable, "-c", PROGRAM], **pipes) as process:
        assert process.stdout.readline().startswith("Serving XML-RPC")
        process.send_signal(signal.SIGTERM)
        out, error = process.communicate(timeout=60)
    assert (process.returncode, out, error) == (0, "", "")


def test_without_it_nobody_answers():
    assert not is_daemon_running(None)
    assert not shutdown_daemon(None)
    with DaemonNode(None) as node:
        assert not node.connected
        with pytest.raises(ConnectionRefusedError):
            assert node.methods


def test_another_program_has_the_port(capsys):
    def answer(server):
        with suppress(OSError):
            while True:
                connection, _ = server.accept()
                with connection:
                    connection.sendall(b"SSH-2.0-none\r\n")

    with socket.create_server(daemon.get_address()) as server:
        thread = threading.Thread(target=answer, args=(server,))
        thread.start()
        assert not is_daemon_running(None)
        assert main(["daemon", "start"]) == 1
        assert "is in use by another program" in capsys.readouterr().err
        with NodeStrategy(None) as node:
            assert node.daemon_node is None
        server.shutdown(socket.SHUT_RDWR)
        thread.join()


def test_the_port_is_that_of_the_domain(monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", "7")
    assert daemon.get_port() == 11518
    assert daemon.get_address() == ("127.0.0.1", 11518)
    assert daemon.get_xmlrpc_server_url() == "http://127.0.0.1:11518/ros2cli/"
    assert daemon.get_xmlrpc_server_url(("robot", 1)) == "http://robot:1/ros2cli/"


def test_a_node_is_made_anew_when_the_addresses_change(monkeypatch, capsys):
    addresses = ["127.0.0.1"]
    monkeypatch.setattr(network_aware, "get_interfaces_ip_addresses", lambda: list(addresses))
    args = argparse.Namespace(node_name_suffix="_probe")
    with network_aware.NetworkAwareNode(args) as node:
        first = node.node
        assert isinstance(first, DirectNode)
        assert node.get_name() == "_ros2cli_probe"
        assert node.node is first
        addresses.append("192.0.2.1")
        assert node.get_name() == "_ros2cli_probe"
        assert node.node is not first
        assert node.context.ok()
    assert capsys.readouterr().out == "Daemon node was reset\n"
    assert not rclpy.ok()


def test_objects_of_rclpy_survive_the_way():
    topic = TopicEndpointInfo(
        "talker",
        "/far",
        "std_msgs/msg/String",
        TypeHash(1, bytes(range(32))),
        EndpointTypeEnum.PUBLISHER,
        list(range(16)),
        qos_profile_sensor_data,
    )
    service = ServiceEndpointInfo(
        "server", "/", qos_profiles=[QoSProfile(depth=3)], endpoint_gids=[[1]], endpoint_count=1
    )
    values = (topic, service, Duration(nanoseconds=2**40), ReliabilityPolicy.BEST_EFFORT, None)
    text = xmlrpc.client.dumps(values, "call", allow_none=True)
    assert f"<{fullname(TopicEndpointInfo)}>" in text
    assert xmlrpc.client.loads(text) == (values, "call")
    assert type(qos_profile_sensor_data.reliability) in policy_types


def test_a_function_gets_a_socket_in_another_process():
    here, there = socket.socketpair()
    with here:
        with there:
            send = functools.partial(socket.socket.sendall, there, b"hello")
            daemonize.daemonize(send, tags={"name": "probe"}, timeout=60)
        assert here.recv(100) == b"hello"
        assert here.recv(100) == b""


def test_a_process_that_does_not_start():
    with pytest.raises(RuntimeError, match="ended before it called"):
        daemonize.daemonize(Exits())


class Exits:
    """Ends the process that reads it."""

    def __call__(self):
        pass

    def __reduce__(self):
        return sys.exit, (3,)


def test_events_are_pickled_as_they_are(tmp_path):
    for is_set in (True, False):
        event = threading.Event()
        if is_set:
            event.set()
        with (tmp_path / "event").open("wb") as file:
            daemonize.PicklerForProcess(None, file).dump(event)
        with (tmp_path / "event").open("rb") as file:
            copy = pickle.load(file)
        assert copy.is_set() is is_set
