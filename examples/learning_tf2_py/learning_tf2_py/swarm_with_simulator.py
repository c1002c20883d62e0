"""The swarm and turtlewire's simulator in one process: poses are shared, not sent."""

import sys

import rclpy
from learning_tf2_py.swarm import Swarm
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

try:
    from turtlesim.turtlesim_node import TurtlesimNode
except ImportError:  # the simulator of ROS 2 is a C++ program
    TurtlesimNode = None


def main(args=None):
    if TurtlesimNode is None:
        sys.exit("This simulator cannot share a process: run turtlesim_node and swarm instead.")
    rclpy.init(args=args)
    try:
        simulator = TurtlesimNode()
        executor = SingleThreadedExecutor()
        for node in (simulator, Swarm(simulator.pose_of)):
            executor.add_node(node)
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
