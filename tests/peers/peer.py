"""A real ROS 2 node on Fast DDS, for tests/peers: run by the Python of scripts/peers, not by ours.

`peer.py node` offers topics, services, parameters and an action until it is killed, and prints what
it receives. `peer.py client COUNT` calls /echo that often.
"""

import contextlib
import sys

import rclpy
import rclpy.executors
from geometry_msgs.msg import TransformStamped
from lifecycle_msgs.srv import GetState
from rclpy.action import ActionServer
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image
from std_msgs.msg import String
from test_msgs.action import Fibonacci
from test_msgs.srv import BasicTypes


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
        self.create_service(BasicTypes, "echo", self.echo)
        self.create_service(GetState, "~/get_state", lambda _, response: response)
        self.action = ActionServer(self, Fibonacci, "fibonacci", self.count)

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
        goal.succeed()
        return Fibonacci.Result(sequence=[0, 1, 1])


def call(count):
    node = rclpy.create_node("peers_client")
    client = node.create_client(BasicTypes, "echo")
    say("server:", client.wait_for_service(30.0))
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(node)
    for number in range(count):
        future = client.call_async(BasicTypes.Request(int64_value=number, string_value="x" * 100))
        executor.spin_until_future_complete(future, timeout_sec=3.0)
        say("answer:", future.result().int64_value if future.done() else None)


rclpy.init()
if sys.argv[1] == "node":
    with contextlib.suppress(rclpy.executors.ExternalShutdownException):  # SIGTERM
        rclpy.spin(Peer())
else:
    call(int(sys.argv[2]))
