"""The follow demo as the tutorials of Lyrical have it written, with `ROS_DISTRO=lyrical`.

Its programs use `with rclpy.init()` and `turtlesim_msgs`; its launch files come in three languages.
"""

import pytest
from tests.places import ROS2

BROADCASTER = """
import math

from geometry_msgs.msg import TransformStamped
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from tf2_ros import TransformBroadcaster
from turtlesim_msgs.msg import Pose


class Broadcaster(Node):
    def __init__(self):
        super().__init__('broadcaster')
        self.turtle = self.declare_parameter('turtlename', 'turtle') \\
            .get_parameter_value().string_value
        self.broadcaster = TransformBroadcaster(self)
        self.subscription = self.create_subscription(
            Pose, f'/{self.turtle}/pose', self.on_pose, 1)

    def on_pose(self, pose):
        transform = TransformStamped()
        transform.header.stamp = self.get_clock().now().to_msg()
        transform.header.frame_id = 'world'
        transform.child_frame_id = self.turtle
        transform.transform.translation.x = pose.x
        transform.transform.translation.y = pose.y
        transform.transform.rotation.z = math.sin(pose.theta / 2)
        transform.transform.rotation.w = math.cos(pose.theta / 2)
        self.broadcaster.sendTransform(transform)


def main():
    try:
        with rclpy.init():
            rclpy.spin(Broadcaster())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
"""

LISTENER = """
import math

from geometry_msgs.msg import Twist
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from tf2_ros import TransformException
from tf2_ros.buffer import Buffer
from tf2_ros.transform_listener import TransformListener
from turtlesim_msgs.srv import Spawn


class Listener(Node):
    def __init__(self):
        super().__init__('listener')
        self.target = self.declare_parameter('target_frame', 'turtle1') \\
            .get_parameter_value().string_value
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.spawner = self.create_client(Spawn, 'spawn')
        self.spawned = None
        self.publisher = self.create_publisher(Twist, 'turtle2/cmd_vel', 1)
        self.timer = self.create_timer(0.1, self.on_timer)

    def on_timer(self):
        if self.spawned is None:
            if self.spawner.service_is_ready():
                request = Spawn.Request(name='turtle2', x=4.0, y=2.0, theta=0.0)
                self.spawned = self.spawner.call_async(request)
            return
        if not self.spawned.done():
            return
        try:
            found = self.buffer.lookup_transform('turtle2', self.target, rclpy.time.Time())
        except TransformException as error:
            self.get_logger().info(f'Could not transform: {error}')
            return
        where = found.transform.translation
        command = Twist()
        command.angular.z = math.atan2(where.y, where.x)
        command.linear.x = 0.5 * math.hypot(where.x, where.y)
        self.publisher.publish(command)
        if math.hypot(where.x, where.y) < 1.0:
            self.get_logger().info('close', once=True)


def main():
    try:
        with rclpy.init():
            rclpy.spin(Listener())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
"""

SETUP = """
entry_points={
    'console_scripts': [
        'turtle_tf2_broadcaster = lyrical_tf2.turtle_tf2_broadcaster:main',
        'turtle_tf2_listener = lyrical_tf2.turtle_tf2_listener:main',
    ],
}
"""

PYTHON = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    def broadcaster(turtle):
        return Node(package='lyrical_tf2', executable='turtle_tf2_broadcaster',
                    name=f'broadcaster_{turtle}', parameters=[{'turtlename': turtle}])

    return LaunchDescription([
        Node(package='turtlesim', executable='turtlesim_node', name='sim'),
        broadcaster('turtle1'),
        DeclareLaunchArgument('target_frame', default_value='turtle1'),
        broadcaster('turtle2'),
        Node(package='lyrical_tf2', executable='turtle_tf2_listener', name='listener',
             parameters=[{'target_frame': LaunchConfiguration('target_frame')}]),
    ])
"""

INCLUDING = """
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.substitutions import PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        IncludeLaunchDescription(
            PathJoinSubstitution([FindPackageShare('lyrical_tf2'), 'launch', 'demo_launch.py']),
            launch_arguments={'target_frame': 'turtle1'}.items(),
        ),
    ])
"""

XML = """
<launch>
  <node pkg="turtlesim" exec="turtlesim_node" name="sim"/>
  <arg name="target_frame" default="turtle1" description="Target frame name."/>
  <for_each values="{turtle: turtle1};{turtle: turtle2}">
    <node pkg="lyrical_tf2" exec="turtle_tf2_broadcaster" name="broadcaster_$(for-var turtle)">
      <param name="turtlename" value="$(for-var turtle)"/>
    </node>
  </for_each>
  <node pkg="lyrical_tf2" exec="turtle_tf2_listener" name="listener">
    <param name="target_frame" value="$(var target_frame)"/>
  </node>
</launch>
"""

YAML = """%YAML 1.2
---
launch:
- node: {pkg: turtlesim, exec: turtlesim_node, name: sim}
- node:
    pkg: lyrical_tf2
    exec: turtle_tf2_broadcaster
    name: broadcaster_1
    param: [{name: turtlename, value: turtle1}]
- include:
    file: "$(find-pkg-share lyrical_tf2)/launch/rest_launch.xml"
"""

REST = """
<launch>
  <node pkg="lyrical_tf2" exec="turtle_tf2_broadcaster" name="broadcaster_2">
    <param name="turtlename" value="turtle2"/>
  </node>
  <node pkg="lyrical_tf2" exec="turtle_tf2_listener" name="listener"/>
</launch>
"""

FILES = {
    "setup.py": SETUP,
    "lyrical_tf2/__init__.py": "",
    "lyrical_tf2/turtle_tf2_broadcaster.py": BROADCASTER,
    "lyrical_tf2/turtle_tf2_listener.py": LISTENER,
    "launch/demo_launch.py": PYTHON,
    "launch/including_launch.py": INCLUDING,
    "launch/demo_launch.xml": XML,
    "launch/demo_launch.yaml": YAML,
    "launch/rest_launch.xml": REST,
}


@pytest.mark.slow
@pytest.mark.parametrize(
    "launch_file", ["demo_launch.py", "including_launch.py", "demo_launch.xml", "demo_launch.yaml"]
)
def test_turtle2_comes_close_to_turtle1(run, workspace, tmp_path, launch_file):
    package = tmp_path / "src" / "lyrical_tf2"
    for name, text in FILES.items():
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(text)
    environment = {**workspace(package), "ROS_DISTRO": "lyrical"}
    launch = run(ROS2, "launch", "lyrical_tf2", launch_file, environment=environment)
    launch.wait_for(r"\[listener\]: close")
    types = run(ROS2, "topic", "type", "/turtle1/pose", environment=environment)
    assert (types.wait(), types.text.strip()) == (0, "turtlesim_msgs/msg/Pose")
    launch.end(4)
