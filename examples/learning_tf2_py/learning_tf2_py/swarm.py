"""Drives a swarm in one node: each turtle follows the one before it through TF."""

import math

import rclpy
from geometry_msgs.msg import TransformStamped, Twist
from learning_tf2_py.turtle_tf2_listener import twist_towards
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformBroadcaster, TransformException, TransformListener
from turtlesim.msg import Pose
from turtlesim.srv import Spawn

#: They start on a spiral around the middle of the field, each near the one before it.
MIDDLE, RADIUS = 5.5444, 4.5
#: Each turtle is updated ten times a second, a fifth of them at a time: a shorter wait for the
#: simulator.
GROUPS = 5
PERIOD = 0.1 / GROUPS
#: How many spawn requests may wait for the simulator.
SPAWNING = 8


def place_on_spiral(k, count):
    """Return x, y and the heading inwards of turtle number `k` of `count`."""
    growth = math.sqrt(k / count)
    angle = math.tau * growth * math.sqrt(count) / 3
    return (
        MIDDLE + RADIUS * growth * math.cos(angle),
        MIDDLE + RADIUS * growth * math.sin(angle),
        angle - math.pi / 2,
    )


class Mailboxes(Node):
    """Keeps the newest pose of each turtle and takes it when needed, without callbacks."""

    def __init__(self):
        super().__init__(
            "swarm_mailboxes",
            use_global_arguments=False,
            start_parameter_services=False,
            enable_rosout=False,
        )
        self.boxes = {}

    def newest_pose(self, name):
        """Return the pose that came since the last call, or None."""
        if name not in self.boxes:
            self.boxes[name] = self.create_subscription(
                Pose, f"/{name}/pose", lambda _: None, 1
            ).handle
        news = self.boxes[name].take_message(Pose, False)
        return None if news is None else news[0]


class Member:
    """One turtle of the swarm."""

    def __init__(self, name, swarm):
        self.name = name
        self.place = TransformStamped()
        self.place.header.frame_id = "world"
        self.place.child_frame_id = name
        self.commands = swarm.create_publisher(Twist, f"/{name}/cmd_vel", 1)

    def put(self, pose, stamp):
        """Return the transform of the turtle's frame."""
        self.place.header.stamp = stamp
        self.place.transform.translation.x = pose.x
        self.place.transform.translation.y = pose.y
        self.place.transform.rotation.z = math.sin(pose.theta / 2)
        self.place.transform.rotation.w = math.cos(pose.theta / 2)
        return self.place


class Swarm(Node):
    """Spawns `count` turtles, broadcasts their frames, and drives each after the one before it."""

    def __init__(self, newest_pose):
        """Begin; `newest_pose(name)` returns a turtle's pose, or None if there is no new one."""
        super().__init__("swarm")
        self.newest_pose = newest_pose
        self.count = self.declare_parameter("count", 1000).value
        self.tf_buffer = Buffer()
        self.tf_listener = TransformListener(self.tf_buffer, self)
        self.broadcaster = TransformBroadcaster(self)

        self.members = [Member("turtle1", self)]  # the simulator's own turtle leads; drive it
        self.asked = 1
        self.ticks = 0
        self.spawner = self.create_client(Spawn, "spawn")
        self.create_timer(PERIOD, self.on_timer)

    def on_timer(self):
        self.ticks += 1
        if self.asked == 1 and self.count > 1 and self.spawner.service_is_ready():
            for _ in range(SPAWNING):
                self.spawn_next()
        group = range(self.ticks % GROUPS, len(self.members), GROUPS)
        self.broadcast([self.members[k] for k in group])
        for k in group:
            if k > 0:
                self.drive(k)

    def broadcast(self, members):
        """Broadcast these turtles' frames, in one message."""
        stamp = self.get_clock().now().to_msg()
        poses = [(member, self.newest_pose(member.name)) for member in members]
        self.broadcaster.sendTransform(
            [member.put(pose, stamp) for member, pose in poses if pose is not None]
        )

    def drive(self, k):
        """Drive a turtle towards the one before it."""
        member, leader = self.members[k], self.members[k - 1]
        try:
            place = self.tf_buffer.lookup_transform(
                member.name, leader.name, Time()
            ).transform.translation
        except TransformException as ex:
            self.get_logger().debug(
                f"Could not retrieve transform: {ex}"
            )  # a new turtle is not in TF yet
            return
        member.commands.publish(twist_towards(place.x, place.y))

    def spawn_next(self):
        """Ask the simulator for one more turtle."""
        if self.asked == self.count:
            return
        self.asked += 1
        x, y, theta = place_on_spiral(self.asked, self.count)
        request = Spawn.Request(x=x, y=y, theta=theta, name=f"turtle{self.asked}")
        self.spawner.call_async(request).add_done_callback(
            lambda future: self.on_spawned(request.name, future)
        )

    def on_spawned(self, name, future):
        future.result()  # an empty name means that the turtle exists already: it takes part
        self.members.append(Member(name, self))
        done = len(self.members)
        if done == self.count or done % 100 == 0:
            self.get_logger().info(f"{done} of {self.count} turtles follow the one before them")
        self.spawn_next()


def main(args=None):
    rclpy.init(args=args)
    try:
        rclpy.spin(Swarm(Mailboxes().newest_pose))
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
