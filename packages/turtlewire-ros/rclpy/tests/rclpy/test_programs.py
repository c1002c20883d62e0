"""Whole programs, each in its own process.

Those of ROS 2's introductory examples, over Cyclone DDS, and those of docs/how-to/asyncio.md.
"""

import signal

import pytest
from tests.how_to import blocks, blocks_of
from tests.places import HOW_TO

PUBLISHER = """
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String

class MinimalPublisher(Node):
    def __init__(self):
        super().__init__("minimal_publisher")
        self.publisher_ = self.create_publisher(String, "topic", 10)
        self.timer = self.create_timer(0.02, self.timer_callback)
        self.i = 0

    def timer_callback(self):
        msg = String()
        msg.data = "Hello World: %d" % self.i
        self.publisher_.publish(msg)
        self.get_logger().info('Publishing: "%s"' % msg.data, once=True)
        self.i += 1

def main(args=None):
    try:
        with rclpy.init(args=args):
            rclpy.spin(MinimalPublisher())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass

main()
"""

SUBSCRIBER = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class MinimalSubscriber(Node):
    def __init__(self):
        super().__init__("minimal_subscriber")
        self.subscription = self.create_subscription(String, "topic", self.listener_callback, 10)

    def listener_callback(self, msg):
        print('I heard: "%s"' % msg.data)

def main(args=None):
    rclpy.init(args=args)
    minimal_subscriber = MinimalSubscriber()
    try:
        rclpy.spin(minimal_subscriber)
    except KeyboardInterrupt:
        pass
    minimal_subscriber.destroy_node()
    rclpy.shutdown()

main()
"""

SERVICE = """
import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node

class MinimalService(Node):
    def __init__(self):
        super().__init__("minimal_service")
        self.srv = self.create_service(AddTwoInts, "add_two_ints", self.add_two_ints_callback)

    def add_two_ints_callback(self, request, response):
        response.sum = request.a + request.b
        print("Incoming request\\na: %d b: %d" % (request.a, request.b))
        return response

def main():
    rclpy.init()
    try:
        rclpy.spin(MinimalService())
    except KeyboardInterrupt:
        pass
    rclpy.shutdown()

main()
"""

CLIENT = """
import sys
import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node

class MinimalClientAsync(Node):
    def __init__(self):
        super().__init__("minimal_client_async")
        self.cli = self.create_client(AddTwoInts, "add_two_ints")
        while not self.cli.wait_for_service(timeout_sec=1.0):
            self.get_logger().info("service not available, waiting again...")
        self.req = AddTwoInts.Request()

    def send_request(self, a, b):
        self.req.a = a
        self.req.b = b
        return self.cli.call_async(self.req)

def main():
    rclpy.init()
    minimal_client = MinimalClientAsync()
    future = minimal_client.send_request(int(sys.argv[1]), int(sys.argv[2]))
    rclpy.spin_until_future_complete(minimal_client, future)
    response = future.result()
    request = minimal_client.req
    print("Result of add_two_ints: for %d + %d = %d" % (request.a, request.b, response.sum))
    minimal_client.destroy_node()
    rclpy.shutdown()

main()
"""


def test_publisher_and_subscriber(program):
    subscriber, publisher = program(SUBSCRIBER), program(PUBLISHER)
    heard = [subscriber.read_line() for _ in range(3)]
    numbers = [
        int(line.removeprefix('I heard: "Hello World: ').removesuffix('"')) for line in heard
    ]
    assert numbers == list(range(numbers[0], numbers[0] + 3))
    for each in (publisher, subscriber):
        each.send_signal(signal.SIGINT)
    status, _, errors = publisher.finish()
    assert status == 0
    assert len(errors.splitlines()) == 1
    assert '[minimal_publisher]: Publishing: "Hello World: 0"' in errors
    status, _, errors = subscriber.finish()
    assert (status, errors) == (0, "")


def test_service_and_client(program):
    service = program(SERVICE)
    client = program(CLIENT, "41", "1")
    status, output, _ = client.finish()
    assert (status, output) == (0, "Result of add_two_ints: for 41 + 1 = 42\n")
    assert service.read_line() == "Incoming request"
    assert service.read_line() == "a: 41 b: 1"
    service.send_signal(signal.SIGINT)
    assert service.finish() == (0, "", "")


def test_remapping_on_the_command_line(program):
    subscriber = program(SUBSCRIBER, "--ros-args", "-r", "topic:=/elsewhere", "-r", "__node:=ears")
    publisher = program(
        PUBLISHER, "--ros-args", "--remap", "topic:=elsewhere", "--log-level", "warn"
    )
    assert subscriber.read_line().startswith('I heard: "Hello World: ')
    for each in (publisher, subscriber):
        each.send_signal(signal.SIGTERM)
    assert publisher.finish()[::2] == (0, "")
    status, _, errors = subscriber.finish()
    assert status == 1
    assert errors.splitlines()[-1].startswith("rclpy.executors.ExternalShutdownException")


PAGE = (HOW_TO / "asyncio.md").read_text()
PROGRAMS, OUTPUTS = blocks_of(PAGE, "python"), blocks_of(PAGE, "text")


def test_each_program_has_its_output():
    assert [kind for kind, _ in blocks(PAGE)] == ["python", "text"] * 4


@pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])
@pytest.mark.parametrize("index", range(4))
def test_a_program_prints_what_the_page_says(program, monkeypatch, middleware, index):
    monkeypatch.setenv("RMW_IMPLEMENTATION", middleware)
    monkeypatch.setenv("PYTHONWARNINGS", "error")
    assert program(PROGRAMS[index]).finish() == (0, OUTPUTS[index], "")
