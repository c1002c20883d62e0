"""Waits until it sees a node ``/peer/echo``, asks its service once, and prints how many such nodes
there are.
"""

import sys

from turtlewire.wire import open_context
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.qos import QoS

REQUEST = TypeId("std_srvs/srv/SetBool_Request", "RIHS01_" + "1" * 64)
RESPONSE = TypeId("std_srvs/srv/SetBool_Response", "RIHS01_" + "2" * 64)
SWITCH = ServiceTypes("std_srvs/srv/SetBool", REQUEST, RESPONSE, lambda _: "RIHS01_" + "3" * 64)
LONG = 60_000_000_000
MESSAGE = b"\x00\x01\x00\x00" + bytes(8)

context = open_context()
client = context.create_node("probe").create_client("/peer/service", SWITCH, QoS())
graph = context.graph
if not graph.wait_for(
    lambda: client.is_ready() and any(node.name == "echo" for node in graph.nodes()), LONG
):
    sys.exit(f"no echo: {graph.nodes()}")
client.send_request(MESSAGE)
wait_set = context.create_wait_set()
wait_set.attach(client)
if not wait_set.wait(LONG):
    sys.exit("no answer")
print(sum(node.name == "echo" for node in graph.nodes()))
context.close()
