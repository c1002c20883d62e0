"""The swarm and its simulator in one process: a thousand poses a tick reach their listener without leaving it."""

import rclpy
from learning_tf2_py.swarm import Swarm
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from turtlesim.turtlesim_node import TurtlesimNode  # turtlewire's; beside a simulator in C++ run `swarm`


def main(args=None):
    rclpy.init(args=args)
    try:
        executor = SingleThreadedExecutor()
        for node in (TurtlesimNode(), Swarm()):
            executor.add_node(node)
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
