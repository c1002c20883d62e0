"""Launch tests of ROS nodes.

==================  =========================================================
module              contents
==================  =========================================================
`actions`           keep the nodes of a launch apart from all others
`test_runner`       runs launches of ROS nodes with their tests
`pytest`            the marker ``rostest`` of pytest
`wait_for_topics`   waits until messages have come on topics
`data_republisher`  changes messages of one topic and sends them on another
`message_pump`      spins a node on its own thread
`tools`             filters of what nodes write
==================  =========================================================
"""

from launch_testing_ros import actions, tools
from launch_testing_ros.data_republisher import DataRepublisher
from launch_testing_ros.message_pump import MessagePump
from launch_testing_ros.test_runner import LaunchTestRunner
from launch_testing_ros.wait_for_topics import WaitForTopics

__all__ = [
    "DataRepublisher",
    "LaunchTestRunner",
    "MessagePump",
    "WaitForTopics",
    "actions",
    "tools",
]
