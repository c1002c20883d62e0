"""Runs the follow demo without a page: drives turtle1 in a circle until turtle2 has followed it.

Usage: python elsewhere_follow.py MIDDLEWARE [--router]. scripts/elsewhere runs it with another
Debian's Python; any Python that has the packages works. `--router` puts a Zenoh router in between,
on a separate port. The last line says what ran and how far turtle2 went.
"""

from __future__ import annotations

import contextlib
import math
import os
import platform
import signal
import socket
import subprocess
import sys
import sysconfig
from collections.abc import Iterator

from turtlewire.testing import isolated_domain
from turtlewire.wire.environment import middleware_library

ROS2 = os.path.join(sysconfig.get_path("scripts"), "ros2")
LAUNCH = ("launch", "learning_tf2_py", "turtle_tf2_demo.launch.py")
LIMIT_S = 900.0  # an emulated start-up takes its time
WAY_M = 1.0  # that turtle2 must go


def main(middleware: str, *, with_router: bool) -> int:
    """Return the exit status: 0 once turtle2 has followed, and the launch has ended well."""
    with isolated_domain():  # which leaves the choice of the middleware open
        os.environ |= {"TURTLEWIRE_PORT": "0", "TURTLEWIRE_BROWSER": "0"}
        os.environ["RMW_IMPLEMENTATION"] = middleware
        os.environ["PATH"] = f"{os.path.dirname(ROS2)}{os.pathsep}{os.environ['PATH']}"
        with router() if with_router else contextlib.nullcontext():
            launch = subprocess.Popen([sys.executable, ROS2, *LAUNCH])
            try:
                told = follow()
            finally:
                launch.send_signal(signal.SIGINT)
                status = launch.wait(LIMIT_S)
    print(told or "turtle2 did not follow", flush=True)
    return 0 if told and status == 0 else 1


@contextlib.contextmanager
def router() -> Iterator[None]:
    """A router of Zenoh, and every session connects with it."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        place = f'["tcp/127.0.0.1:{probe.getsockname()[1]}"]'
    own = {**os.environ, "ZENOH_CONFIG_OVERRIDE": f"listen/endpoints={place}"}
    command = [sys.executable, ROS2, "run", "rmw_zenoh_cpp", "rmw_zenohd"]
    process = subprocess.Popen(command, env=own)
    os.environ["ZENOH_CONFIG_OVERRIDE"] = f"connect/endpoints={place}"
    try:
        yield
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(LIMIT_S)


def follow() -> str:
    """Drive turtle1 until turtle2 went far enough; what happened, or nothing if it did not."""
    import rclpy
    from geometry_msgs.msg import Twist
    from rclpy.task import Future
    from tf2_ros import Buffer, TransformListener
    from turtlesim.msg import Pose

    rclpy.init()
    node = rclpy.create_node("judge")
    buffer = Buffer()
    TransformListener(buffer, node)
    publisher = node.create_publisher(Twist, "/turtle1/cmd_vel", 10)
    command = Twist()
    command.linear.x, command.angular.z = 1.0, 0.5
    node.create_timer(0.1, lambda: publisher.publish(command))
    done: Future[float] = Future()
    way, last = 0.0, None

    def moved(pose: Pose) -> None:
        nonlocal way, last
        here = (pose.x, pose.y)
        way += math.dist(here, last or here)
        last = here
        known = buffer.can_transform("turtle2", "turtle1", rclpy.time.Time())
        if way >= WAY_M and known and not done.done():
            done.set_result(way)

    node.create_subscription(Pose, "/turtle2/pose", moved, 10)
    rclpy.spin_until_future_complete(node, done, timeout_sec=LIMIT_S)
    if not done.done():
        return ""
    name = rclpy.get_rmw_implementation_identifier()
    here = f"Python {platform.python_version()} on {platform.machine()}"
    return f"{here}, {name} on {middleware_library(name)}: turtle2 followed for {way:.1f} m"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], with_router="--router" in sys.argv[2:]))
