"""roslibpy, from PyPI, talks to rclpy nodes through a bridge that speaks rosbridge's JSON."""

from __future__ import annotations

import json
import threading

import pytest
from tests.programs import run_python
from websockets.exceptions import ConnectionClosed
from websockets.sync.server import serve

from example_interfaces.srv import AddTwoInts
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rosidl_runtime_py import message_to_ordereddict, set_message_fields
from rosidl_runtime_py.utilities import get_message, get_service
from std_msgs.msg import String

CLIENT = """
import queue, sys
import roslibpy

ros = roslibpy.Ros(host="127.0.0.1", port=int(sys.argv[1]))
ros.run(timeout=60)
heard = queue.SimpleQueue()
shout = roslibpy.Topic(ros, "/shout", "std_msgs/String")
shout.subscribe(heard.put)
say = roslibpy.Topic(ros, "/say", "std_msgs/String")
say.advertise()
say.publish(roslibpy.Message({"data": "hello"}))
print(heard.get(timeout=60))
add = roslibpy.Service(ros, "/add", "example_interfaces/AddTwoInts")
print(dict(add.call(roslibpy.ServiceRequest({"a": 2, "b": 40}), timeout=60)))
nothing = roslibpy.Service(ros, "/nothing", "example_interfaces/AddTwoInts")
try:
    nothing.call(roslibpy.ServiceRequest({}), timeout=60)
except roslibpy.core.ServiceException as error:
    print(error)
ros.terminate()
"""


class Bridge:
    """Acts as rosbridge for one client: topics and services as JSON."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._publishers = {}
        self._group = ReentrantCallbackGroup()

    def talk(self, socket) -> None:
        """Answer a client until it leaves."""
        try:
            for text in socket:
                request = json.loads(text)
                getattr(self, f"_{request['op']}", self._ignore)(socket, request)
        except ConnectionClosed:
            pass  # roslibpy leaves without a farewell

    def _ignore(self, socket, request) -> None:
        """Unadvertise and the like: the node ends with the test."""

    def _advertise(self, socket, request) -> None:
        cls = get_message(full_name(request["type"]))
        self._publishers[request["topic"]] = self._node.create_publisher(cls, request["topic"], 10)

    def _publish(self, socket, request) -> None:
        publisher = self._publishers[request["topic"]]
        message = publisher.msg_type()
        set_message_fields(message, request["msg"])
        publisher.publish(message)

    def _subscribe(self, socket, request) -> None:
        def send(message) -> None:
            fields = message_to_ordereddict(message)
            socket.send(json.dumps({"op": "publish", "topic": request["topic"], "msg": fields}))

        cls = get_message(full_name(request["type"]))
        self._node.create_subscription(cls, request["topic"], send, 10)

    def _call_service(self, socket, request) -> None:
        answer = {"op": "service_response", "service": request["service"], "id": request["id"]}
        types = dict(self._node.get_service_names_and_types()).get(request["service"])
        if types is None:
            values, result = f"there is no service {request['service']}", False
        else:
            cls = get_service(types[0])
            client = self._node.create_client(cls, request["service"], callback_group=self._group)
            asked = cls.Request()
            set_message_fields(asked, request["args"])
            assert client.wait_for_service(60)
            values, result = message_to_ordereddict(client.call(asked)), True
        socket.send(json.dumps(answer | {"values": values, "result": result}))


def full_name(name: str) -> str:
    """``std_msgs/msg/String`` of ``std_msgs/String``, as roslibpy's examples have it."""
    package, _, last = name.partition("/")
    return f"{package}/msg/{last.removeprefix('msg/')}"


@pytest.fixture
def port(monkeypatch):
    """Yield the port of a bridge, next to a node that repeats strings in capitals and adds."""
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    context = Context()
    context.init(args=[])
    node, bridge = Node("worker", context=context), Node("bridge", context=context)
    shout = node.create_publisher(String, "shout", 10)
    node.create_subscription(
        String, "say", lambda message: shout.publish(String(data=message.data.upper())), 10
    )

    def add(request, response):
        response.sum = request.a + request.b
        return response

    node.create_service(AddTwoInts, "add", add)
    executor = MultiThreadedExecutor(context=context)
    executor.add_node(node)
    executor.add_node(bridge)
    threads = [threading.Thread(target=executor.spin)]
    with serve(Bridge(bridge).talk, "127.0.0.1", 0) as server:
        threads.append(threading.Thread(target=server.serve_forever))
        for thread in threads:
            thread.start()
        yield server.socket.getsockname()[1]
        server.shutdown()
        executor.shutdown()
        for thread in threads:
            thread.join()
    context.shutdown()


def test_topics_and_services(port):
    done = run_python(CLIENT, str(port), check=False)
    assert done.stdout.splitlines() == [
        "{'data': 'HELLO'}",
        "{'sum': 42}",
        "there is no service /nothing",
    ], done.stderr
    assert done.returncode == 0
