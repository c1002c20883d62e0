import rclpy


def main(args=None):
    with rclpy.init(args=args):
        rclpy.create_node("gripper").get_logger().info("gripped")
