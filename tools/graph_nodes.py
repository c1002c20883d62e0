"""The nodes of a robot with three mistakes, for pictures and audits of the graph page.

The lidar is best effort, but the mapping requests reliable; the map is not latched, but the planner
requests it so; the joystick sends another type than the wheels take.
"""

from __future__ import annotations

import contextlib
import threading

from geometry_msgs.msg import Twist
from turtlewire import msg, wire
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import Durability, QoS, Reliability

RELIABLE = QoS()
SENSOR = QoS(depth=5, reliability=Reliability.BEST_EFFORT)
LATCHED = QoS(depth=1, durability=Durability.TRANSIENT_LOCAL)
SCAN, MAP = "sensor_msgs/msg/LaserScan", "nav_msgs/msg/OccupancyGrid"
TWIST, STAMPED = "geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped"
ODOM, PATH = "nav_msgs/msg/Odometry", "nav_msgs/msg/Path"
PERIOD_S = 0.1

#: Of each node: what it publishes and what it subscribes to.
NODES = {
    "lidar": ([("/scan", SCAN, SENSOR)], []),
    "mapping": ([("/map", MAP, RELIABLE)], [("/scan", SCAN, RELIABLE), ("/odom", ODOM, RELIABLE)]),
    "planner": ([("/plan", PATH, RELIABLE)], [("/map", MAP, LATCHED)]),
    "controller": ([("/cmd_vel", TWIST, RELIABLE)],
                   [("/plan", PATH, RELIABLE), ("/scan", SCAN, SENSOR)]),
    "joystick": ([("/cmd_vel", STAMPED, RELIABLE)], []),
    "wheels": ([("/odom", ODOM, RELIABLE)], [("/cmd_vel", TWIST, RELIABLE)]),
}  # fmt: skip


def main() -> None:
    """Run the nodes until Ctrl-C; the controller sends ten messages a second."""
    context = wire.open_context()
    publishers = {}
    for name, (publishes, subscribes) in NODES.items():
        node = context.create_node(name)
        for topic, type_name, qos in publishes:
            publishers[name, topic] = node.create_publisher(topic, _identity(type_name), qos)
        for topic, type_name, qos in subscribes:
            node.create_subscription(topic, _identity(type_name), qos, lambda *_: None)
    forward = Twist()
    forward.linear.x = 0.5
    ended = threading.Event()
    while not ended.wait(PERIOD_S):
        publishers["controller", "/cmd_vel"].publish(msg.serialize(forward))


def _identity(type_name: str) -> TypeId:
    return TypeId(type_name, msg.type_hash(type_name))


if __name__ == "__main__":
    with contextlib.suppress(KeyboardInterrupt):
        main()
