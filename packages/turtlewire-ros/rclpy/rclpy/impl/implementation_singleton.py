"""The name under which ROS 2 programs import the C extension.

``from rclpy.impl.implementation_singleton import rclpy_implementation``.
"""

from rclpy import _rclpy_pybind11 as rclpy_implementation

__all__ = ["package", "rclpy_implementation"]

#: Name of the package that has the extension.
package = "rclpy"
