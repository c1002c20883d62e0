"""Our node /ours, which nodes on Fast DDS call in tests/peers, until it is killed."""

import time

import rclpy
from rclpy.action import ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from turtlewire.msg import get_action, get_service

Fibonacci = get_action("test_msgs/action/Fibonacci")


class Server(Node):
    """Echoes, counts, and has a parameter."""

    def __init__(self):
        super().__init__("ours")
        self.declare_parameter("speed", 1.5)
        self.create_service(get_service("test_msgs/srv/BasicTypes"), "echo", self.echo)
        self.action = ActionServer(
            self,
            Fibonacci,
            "fibonacci",
            self.count,
            callback_group=ReentrantCallbackGroup(),
            cancel_callback=lambda _: CancelResponse.ACCEPT,
        )

    def echo(self, request, response):
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
                break
            sequence.append((sequence[-1] + sequence[-2]) % (1 << 31))
            goal.publish_feedback(Fibonacci.Feedback(sequence=sequence))
            time.sleep(0.02)
        else:
            goal.succeed()
        return Fibonacci.Result(sequence=sequence)


with rclpy.init():
    executor = MultiThreadedExecutor()
    executor.add_node(Server())
    print("up", flush=True)
    executor.spin()
