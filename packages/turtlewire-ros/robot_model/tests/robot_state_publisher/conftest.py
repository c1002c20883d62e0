"""A robot_state_publisher in this process, and what it sends."""

import gc
import time

import pytest

from geometry_msgs.msg import TransformStamped
from rcl_interfaces.srv import SetParameters
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import serialize_message
from robot_state_publisher import RobotStatePublisher
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

LATCHED = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Rig:
    """The node, and another one that hears and feeds it."""

    def __init__(self, context, description, **parameters):
        given = {"robot_description": description, **parameters}
        self.publisher = RobotStatePublisher(
            context=context,
            parameter_overrides=[Parameter(name, value=value) for name, value in given.items()],
        )
        self.node = Node("robot_state_rig", context=context)
        self.executor = SingleThreadedExecutor(context=context)
        self.executor.add_node(self.publisher)
        self.executor.add_node(self.node)
        self.dynamic, self.static, self.descriptions = [], [], []
        self._joints = self.node.create_publisher(JointState, "/joint_states", 50)
        self._clock = self.node.create_publisher(Clock, "/clock", 10)
        self._setter = self.node.create_client(
            SetParameters, "/robot_state_publisher/set_parameters"
        )
        self.node.create_subscription(TFMessage, "/tf", self.dynamic.append, 1000)
        self.node.create_subscription(TFMessage, "/tf_static", self.static.append, LATCHED)
        self.node.create_subscription(
            String, "/robot_description", self.descriptions.append, LATCHED
        )
        self._handled = 0
        (subscription,) = (
            found for found in self.publisher.subscriptions if found.topic_name == "/joint_states"
        )
        handle = subscription.callback

        def counting(message):
            handle(message)
            self._handled += 1

        subscription.callback = counting
        self.spin_until(lambda: self.static and self.descriptions)
        self.spin_until(self._joints.get_subscription_count)
        self.spin_until(self.publisher._dynamic.pub_tf.get_subscription_count)

    def spin_until(self, condition):
        end = time.monotonic() + 60
        while not condition():
            assert time.monotonic() < end, "it did not happen"
            # What native code has done wakes no executor.
            self.executor.spin_once(timeout_sec=0.01)

    @property
    def relayed(self):
        """How many joint states native code has handled."""
        relay = self.publisher._relay
        return 0 if relay is None else relay.relayed()

    @property
    def handled(self):
        """How many joint states were handled."""
        return self._handled + self.relayed

    def send(self, message):
        """Publish a JointState, and return when it was handled."""
        wanted = self.handled + 1
        self._joints.publish(message if isinstance(message, bytes) else serialize_message(message))
        self.spin_until(lambda: self.handled >= wanted)

    def transforms(self):
        """The TFMessages since the last call."""
        end = TFMessage(transforms=[TransformStamped(child_frame_id="end")])
        self.publisher._dynamic.pub_tf.publish(end)
        self.spin_until(lambda: self.dynamic and self.dynamic[-1] == end)
        found = self.dynamic[:-1]
        self.dynamic.clear()
        return found

    def set_clock(self, ns):
        message = Clock()
        message.clock.sec, message.clock.nanosec = divmod(ns, 10**9)
        self._clock.publish(message)
        clock = self.publisher.get_clock()
        self.spin_until(lambda: clock.now().nanoseconds == ns)

    def set_parameter(self, name, value):
        request = SetParameters.Request(
            parameters=[Parameter(name, value=value).to_parameter_msg()]
        )
        future = self._setter.call_async(request)
        self.spin_until(future.done)
        (result,) = future.result().results
        return [result.successful, result.reason]

    def close(self):
        self.executor.shutdown()
        self.publisher.destroy_node()
        self.node.destroy_node()


@pytest.fixture(params=["local", "rmw_cyclonedds_cpp"])
def rig(request, monkeypatch):
    """Makes a Rig of a description and parameters; with Cyclone, native code does most."""
    monkeypatch.setenv("RMW_IMPLEMENTATION", request.param)
    context = Context()
    context.init(args=[])
    rigs = []

    def make(description, **parameters):
        gc.collect()  # a node that refused to start keeps its name until it is collected
        rigs.append(Rig(context, description, **parameters))
        return rigs[-1]

    yield make
    for each in rigs:
        each.close()
    context.try_shutdown()
