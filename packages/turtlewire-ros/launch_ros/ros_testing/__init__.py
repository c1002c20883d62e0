"""Names the package that ``package.xml`` files depend on to run ``ros2 test``.

In ROS 2 it holds CMake's ``add_ros_test``, and no Python either.
"""
