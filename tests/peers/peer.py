"""A real ROS 2 node on Fast DDS, for tests/peers: run by the Python of scripts/peers, not by ours.

`peer.py node` offers topics, services, parameters and an action until it is killed, and prints what
it receives. `peer.py client COUNT [BYTES [SECONDS [SERVICE]]]` calls /echo or another service that
often, with texts of that size, and waits so long for each answer; `peer.py parameters NODE` lists,
sets and gets those of a node; `peer.py action ORDER [cancel]` sends a goal to /fibonacci. `peer.py
crowd` has 20 nodes with parameters; `peer.py ask NODE ...` gets those of several nodes. `peer.py
gone` waits until /echo has a server, and then until it has none.
"""

import contextlib
import sys
import time

import rclpy
import rclpy.executors
import rclpy.task
from geometry_msgs.msg import TransformStamped
from lifecycle_msgs.srv import GetState
from rcl_interfaces.srv import ListParameters
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from rclpy.qos import QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import Image
from std_msgs.msg import String
from test_msgs.action import Fibonacci
from test_msgs.srv import BasicTypes

#: The replies to all clients of a service share their queues.
DEEP = QoSProfile(depth=1000)


def say(*words):
    print(*words, flush=True)


class Peer(Node):
    def __init__(self):
        super().__init__("peer")
        self.declare_parameter("speed", 1.5)
        chatter = self.create_publisher(String, "chatter", 10)
        self.create_timer(0.1, lambda: chatter.publish(String(data="from Fast DDS")))
        self.moved = self.create_publisher(TransformStamped, "moved", 10)
        self.listen(String, "heard", lambda message: say("heard", message.data), 10)
        self.listen(TransformStamped, "move", self.move, 10)
        self.listen(Image, "image", self.look, 10)
        self.listen(Image, "camera", self.look, qos_profile_sensor_data)
        self.create_service(BasicTypes, "echo", self.echo, qos_profile=DEEP)
        self.create_service(GetState, "~/get_state", lambda _, response: response)
        self.action = ActionServer(
            self,
            Fibonacci,
            "fibonacci",
            self.count,
            callback_group=ReentrantCallbackGroup(),
            cancel_callback=lambda _: CancelResponse.ACCEPT,
        )

    def listen(self, message_class, topic, callback, qos):
        def matched(status):
            say(f"publishers of /{topic}: {status.current_count}")

        events = SubscriptionEventCallbacks(matched=matched)
        self.create_subscription(message_class, topic, callback, qos, event_callbacks=events)

    def move(self, message):
        message.transform.translation.x += 1.0
        self.moved.publish(message)

    def look(self, message):
        say("image", message.header.frame_id, len(message.data))

    def echo(self, request, response):
        say("called", request.int64_value)
        response.int64_value = request.int64_value
        response.string_value = request.string_value
        return response

    def count(self, goal):
        # A client knows the server first; feedback before its subscription is known gets lost.
        end = time.monotonic() + 30.0
        while not self.count_subscribers("/fibonacci/_action/feedback") and time.monotonic() < end:
            time.sleep(0.01)
        sequence = [0, 1]
        for _ in range(goal.request.order - 1):
            if goal.is_cancel_requested:
                goal.canceled()
                return Fibonacci.Result(sequence=sequence)
            sequence.append((sequence[-1] + sequence[-2]) % (1 << 31))
            goal.publish_feedback(Fibonacci.Feedback(sequence=sequence))
            time.sleep(0.02)
        goal.succeed()
        return Fibonacci.Result(sequence=sequence)


class Caller:
    """A node that waits for one answer after the other."""

    def __init__(self):
        self.node = rclpy.create_node("peers_client")
        self.executor = rclpy.executors.SingleThreadedExecutor()
        self.executor.add_node(self.node)

    def result(self, future, timeout=30.0):
        end = time.monotonic() + timeout  # not spin_until_future_complete: it takes 10 ms a call
        while not future.done() and (rest := end - time.monotonic()) > 0.0:
            self.executor.spin_once(rest)
        return future.result() if future.done() else None


def call(count, size="100", timeout="30", service="echo"):
    caller = Caller()
    client = caller.node.create_client(BasicTypes, service, qos_profile=DEEP)
    say("server:", client.wait_for_service(30.0))
    text = "x" * int(size)
    for number in range(int(count)):
        request = BasicTypes.Request(int64_value=number, string_value=text)
        response = caller.result(client.call_async(request), float(timeout))
        right = response is not None and response.string_value == text
        say("answer:", response.int64_value if right else None)


def ask_parameters(node):
    caller = Caller()
    lister = caller.node.create_client(ListParameters, f"{node}/list_parameters")
    say("server:", lister.wait_for_service(30.0))
    say("names:", *caller.result(lister.call_async(ListParameters.Request())).result.names)
    client = AsyncParameterClient(caller.node, node)
    client.wait_for_services(30.0)
    answer = caller.result(client.set_parameters([Parameter("speed", value=2.5)]))
    say("set:", answer.results[0].successful)
    say("speed:", caller.result(client.get_parameters(["speed"])).values[0].double_value)


def be_crowd():
    executor = rclpy.executors.SingleThreadedExecutor()
    for number in range(20):
        node = rclpy.create_node(f"peer{number}")
        node.declare_parameter("number", number)
        executor.add_node(node)
    say("up")
    executor.spin()


def ask_crowd(*nodes):
    caller = Caller()
    clients = [AsyncParameterClient(caller.node, node) for node in nodes]
    for client in clients:
        client.wait_for_services(30.0)
    futures = [client.get_parameters(["number"]) for client in clients]
    say("numbers:", *(caller.result(future).values[0].integer_value for future in futures))


def see_server_go():
    caller = Caller()
    client = caller.node.create_client(BasicTypes, "echo")
    say("server:", client.wait_for_service(30.0))
    while client.service_is_ready():
        caller.executor.spin_once(0.1)
    say("gone")


def send_goal(order, cancel=""):
    caller = Caller()
    client = ActionClient(caller.node, Fibonacci, "fibonacci")
    say("server:", client.wait_for_server(30.0))
    heard = rclpy.task.Future()

    def feedback(message):
        if not heard.done():
            heard.set_result(list(message.feedback.sequence))

    handle = caller.result(client.send_goal_async(Fibonacci.Goal(order=int(order)), feedback))
    say("accepted:", handle.accepted)
    say("feedback:", caller.result(heard))
    if cancel:
        say("cancelled:", len(caller.result(handle.cancel_goal_async()).goals_canceling))
    for _ in range(2):  # the second asks for a result that is there
        answer = caller.result(handle.get_result_async())
        say("result:", answer.status, list(answer.result.sequence))


rclpy.init()
kind, *arguments = sys.argv[1:]
if kind == "node":
    executor = rclpy.executors.MultiThreadedExecutor()
    executor.add_node(Peer())
    with contextlib.suppress(rclpy.executors.ExternalShutdownException):  # SIGTERM
        executor.spin()
else:
    kinds = {"client": call, "parameters": ask_parameters, "action": send_goal}
    (kinds | {"crowd": be_crowd, "ask": ask_crowd, "gone": see_server_go})[kind](*arguments)
