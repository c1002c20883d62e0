"""The swarm and its simulator in one process, which shares the poses: nobody listens to their topics, so that none is sent."""

import rclpy
from learning_tf2_py.swarm import Swarm
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from turtlesim.turtlesim_node import (
    TurtlesimNode,
)  # turtlewire's; beside a simulator in C++ run `swarm`


def main(args=None):
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
