"""The sockets at which a middleware receives are bound to the loopback interface."""

import socket
import sys

import pytest

from turtlewire import msg, wire
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.loopback import ANY_PORT, bind_to_loopback, open_sockets
from turtlewire.wire.qos import QoS

pytestmark = pytest.mark.skipif(
    sys.platform != "linux", reason="only Linux binds sockets to interfaces"
)


@pytest.fixture
def udp():
    """Opens UDP sockets at addresses."""
    opened = []

    def bind(host):
        opened.append(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
        opened[-1].bind((host, 0))
        return opened[-1]

    yield bind
    for each in opened:
        each.close()


def interface_of(each):
    return each.getsockopt(socket.SOL_SOCKET, socket.SO_BINDTODEVICE, 16).rstrip(b"\0")


def test_new_sockets_at_the_domain_s_ports_are_bound(udp):
    older = udp("0.0.0.0")
    former = open_sockets()
    group = udp("224.0.0.224")
    received, sent, other = udp("0.0.0.0"), udp("127.0.0.1"), udp("0.0.0.0")
    bind_to_loopback(former, [each.getsockname()[1] for each in (received, older, group)])
    assert interface_of(group) == b""
    assert interface_of(received) == b"lo"
    assert interface_of(older) == interface_of(sent) == interface_of(other) == b""


@pytest.mark.parametrize("has_settings", [True, False])
def test_settings_that_add_an_interface_leave_the_sockets_alone(udp, monkeypatch, has_settings):
    """Without settings, the socket to elsewhere is one that another thread has opened."""
    if has_settings:
        monkeypatch.setenv("CYCLONEDDS_URI", "<Domain/>")
    else:
        monkeypatch.delenv("CYCLONEDDS_URI", raising=False)
    former = open_sockets()
    received, sent = udp("0.0.0.0"), udp("0.0.0.0")
    try:
        sent.connect(("192.0.2.1", 9))  # takes the address of the interface that leads there
    except OSError:
        pytest.skip("this host has no interface that leads anywhere but to itself")
    bind_to_loopback(former, ANY_PORT)
    assert interface_of(received) == (b"" if has_settings else b"lo")


def test_a_kernel_that_refuses_is_warned_of(udp, capfd, monkeypatch):
    former = open_sockets()
    udp("0.0.0.0")
    monkeypatch.setattr(socket, "SO_BINDTODEVICE", 9999)
    bind_to_loopback(former, ANY_PORT)
    assert "datagrams from other computers reach this process" in capfd.readouterr().err


def test_a_service_opens_no_socket():
    """So that many nodes of a process, each with seven services, stay below its limit of files."""
    context = wire.open_context(middleware="rmw_cyclonedds_cpp")
    node = context.create_node("served")
    names = ("std_srvs/srv/Empty_Request", "std_srvs/srv/Empty_Response")
    types = [TypeId(name, msg.type_hash(name)) for name in names]
    service = ServiceTypes("std_srvs/srv/Empty", *types, msg.type_hash)
    node.create_service("/first", service, QoS())
    before = open_sockets()
    for number in range(10):
        node.create_service(f"/service_{number}", service, QoS())
    assert open_sockets() == before
    context.close()
