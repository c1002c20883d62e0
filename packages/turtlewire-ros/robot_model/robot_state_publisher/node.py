"""The node: joint states in, transforms out."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import TransformStamped
from rcl_interfaces.msg import SetParametersResult
from rclpy._node.endpoints import QosOverrides
from rclpy.clock import JumpThreshold
from rclpy.clock_type import ClockType
from rclpy.duration import Duration
from rclpy.exceptions import InvalidParameterTypeException
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.qos_overriding_options import QoSOverridingOptions
from robot_state_publisher.description import (
    RobotDescriptionError,
    oddities,
    parse_description,
    static_joints,
)
from robot_state_publisher.diagnosis import Diagnosis
from robot_state_publisher.publish_times import PublishTimes
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster
from turtlewire.distro import LYRICAL, since
from turtlewire.errors import CdrError
from turtlewire.terminal.printable import printable
from turtlewire.urdf import UrdfError
from turtlewire.urdf.joint_messages import JointMessages, stamp_of
from turtlewire.urdf.joints import followers_of

if TYPE_CHECKING:
    from builtin_interfaces.msg import Time
    from rclpy.clock import TimeJump
    from rclpy.parameter import Parameter
    from rclpy.publisher import Publisher
    from turtlewire._native import JointRelay
    from turtlewire.urdf import Joint, Robot
    from turtlewire.urdf.joint_messages import Layout

_FALLBACK = (
    "No robot_description parameter, but command-line argument available.  Assuming argument is"
    " name of URDF file.  This backwards compatibility fallback will be removed in the future."
)

_NO_DESCRIPTION = (
    "Give the URDF as a parameter, for example in a launch file: {'robot_description':"
    " ParameterValue(Command(['xacro ', path]), value_type=str)}"
)


class StartError(RuntimeError):
    """The node cannot start; the text is ROS 2's.

    Attributes:
        hint: Advice; may be empty.
    """

    def __init__(self, text: str, hint: str = "") -> None:
        super().__init__(text)
        self.hint = hint


class RobotStatePublisher(Node):
    """Publishes where the links of a robot are.

    Parameters: ``robot_description`` (URDF), ``publish_frequency`` (0 to 1000 Hz, 0: no limit; in
    Lyrical more than 0), ``ignore_timestamp`` and ``frame_prefix``; all can be changed at run time.
    In Lyrical, ``use_robot_description_topic`` takes the URDF from the topic ``robot_description``
    instead of the parameter of that name.

    Args:
        urdf_file: Path of a URDF that is read if the parameter ``robot_description`` is empty;
            ignored in Lyrical.
        **options: Options of the node.

    Raises:
        StartError: The description is missing, or it or another parameter is invalid.
    """

    def __init__(self, *, urdf_file: str | None = None, **options: Any) -> None:
        super().__init__("robot_state_publisher", **options)
        awaits_topic = since(LYRICAL) and self._declare("use_robot_description_topic", False)
        description = "" if awaits_topic else self._first_description(urdf_file)
        self._frequency: float = self._declare("publish_frequency", 20.0)
        if not _is_frequency(self._frequency):
            lowest = "0 (exclusive)" if since(LYRICAL) else "0"
            raise StartError(f"publish_frequency must be between {lowest} and 1000")
        self._ignores_stamps: bool = self._declare("ignore_timestamp", False)
        self._prefix: str = self._declare("frame_prefix", "")
        self._diagnosis = Diagnosis(self)
        self._dynamic = TransformBroadcaster(self)
        self._relay = self._make_relay()
        self._times = PublishTimes() if self._relay is None else self._relay
        self._follow_clock()
        self._static = StaticTransformBroadcaster(self)
        self._description_publisher: Publisher[String] | None = None
        self._robot: Robot | None = None
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        if awaits_topic:
            self.create_subscription(String, "robot_description", self._take_description, latched)
        else:
            try:
                robot = parse_description(description)
            except RobotDescriptionError as error:
                raise StartError(str(error)) from error
            self._description_publisher = self.create_publisher(
                String, "robot_description", latched
            )
            self._start_with(robot, description)
        # After the declarations: for wrong values at the start, ROS 2 has other texts.
        self.add_on_set_parameters_callback(self._check_parameters)
        self.add_post_set_parameters_callback(self._use_parameters)
        # Last: joint states may arrive as soon as the subscription is made.
        if self._robot is not None:
            self._subscribe()

    @property
    def robot(self) -> Robot:
        """The robot whose links are published.

        Raises:
            RuntimeError: No description has arrived on the topic yet.
        """
        if self._robot is None:
            raise RuntimeError("no description of a robot has arrived on robot_description yet")
        return self._robot

    def _first_description(self, urdf_file: str | None) -> str:
        description: str = self._declare("robot_description", "")
        return description or self._read_file(None if since(LYRICAL) else urdf_file)

    def _take_description(self, message: String) -> None:
        """Use a description from the topic."""
        try:
            robot = parse_description(message.data)
        except RobotDescriptionError as error:
            text = f"Failed to parse robot description from topic: {error}"
            self.get_logger().error(printable(text))
            return
        is_first = self._robot is None
        self._start_with(robot, message.data)
        if is_first:
            self._subscribe()

    def _start_with(self, robot: Robot, description: str) -> None:
        self._robot = robot
        self._use_robot(robot)
        self._publish_robot(robot, description)

    def _subscribe(self) -> None:
        # Not `Node.create_subscription`, which has no sink to pass messages to the relay first.
        self._rclpy_endpoints.create_subscription(
            JointState,
            "joint_states",
            self._on_joint_state,
            qos_profile_sensor_data,
            callback_group=None,
            event_callbacks=None,
            raw=True,
            overrides=QosOverrides(QoSOverridingOptions.with_default_policies(), self._parameters),
            sink=self._relay,
        )

    def _declare(self, name: str, default: Any) -> Any:
        try:
            return self.declare_parameter(name, default).value
        except InvalidParameterTypeException as error:
            # The types stand only in the text of the exception.
            types = re.findall(r" type '([A-Z_]+)'", str(error))
            given, expected = (found.lower() for found in types[-2:])
            raise StartError(
                f"parameter '{name}' has invalid type: Wrong parameter type, parameter {{{name}}}"
                f" is of type {{{expected}}}, setting it to {{{given}}} is not allowed.",
                error.hint,
            ) from error

    def _make_relay(self) -> JointRelay | None:
        """Return native code that answers joint states like the ones Python has handled."""
        outlet = self._dynamic.pub_tf._rclpy_outlet
        if outlet is None:
            return None
        from turtlewire._native import JointRelay

        return JointRelay(outlet, qos_profile_sensor_data.depth)

    def _follow_clock(self) -> None:
        """Give the relay the time of a simulated clock, now and whenever it moves."""
        clock, relay = self.get_clock(), self._relay
        if relay is None:
            return

        def moved(_jump: TimeJump | None = None) -> None:
            is_simulated = clock.clock_type == ClockType.ROS_TIME and clock.ros_time_is_active
            relay.set_time(clock.now().nanoseconds if is_simulated else None)

        # The smallest step, because the relay cannot read the clock and needs each move of it.
        step = Duration(nanoseconds=1)
        every_jump = JumpThreshold(min_forward=step, min_backward=Duration(nanoseconds=-1))
        clock.create_jump_callback(every_jump, post_callback=moved)
        moved()

    def _rules_changed(self) -> None:
        if self._relay is not None:
            self._relay.set_rules(
                self._interval_ms() * 1_000_000,
                self._ignores_stamps,
                self._diagnosis.tells_of_skipping,
            )

    def _interval_ms(self) -> int:
        # Whole milliseconds, as in ROS 2.
        return int(1000.0 / self._frequency) if self._frequency else 0

    def _read_file(self, path: str | None) -> str:
        if path is None:
            text = "robot_description parameter must not be empty"
            self.get_logger().fatal(text)
            raise StartError(text, _NO_DESCRIPTION)
        self.get_logger().warning(_FALLBACK)
        try:
            with open(path, encoding="utf-8") as file:
                return file.read()
        except (OSError, UnicodeDecodeError) as error:
            reason = error.strerror if isinstance(error, OSError) else error
            text = f"Failed to open URDF file: {path}: {reason}"
            self.get_logger().fatal(text)
            raise StartError(text) from error

    def _use_robot(self, robot: Robot) -> None:
        """Take over the robot, and log what is odd about it."""
        kdl = get_logger("kdl_parser")
        for text in oddities(robot):
            kdl.warning(printable(text))
        try:
            followers_of(robot)
        except UrdfError as error:
            self.get_logger().warning(printable(f"{error} ({error.place})"))
        self._use_names(robot)
        self.get_logger().info("Robot initialized")
        self._diagnosis.start(robot)

    def _use_names(self, robot: Robot) -> None:
        self._joints = JointMessages(robot, self._prefix)
        if self._relay is not None:
            self._relay.forget_layouts()

    def _publish_robot(self, robot: Robot, description: str) -> None:
        if self._description_publisher is not None:
            self._description_publisher.publish(String(data=description))
        now = self.get_clock().now().to_msg()
        self._static.sendTransform(
            [_transform(joint, self._prefix, now) for joint in static_joints(robot)]
        )

    def _check_parameters(self, parameters: Sequence[Parameter]) -> SetParametersResult:
        for parameter in parameters:
            reason = self._refusal(parameter)
            if reason:
                return SetParametersResult(successful=False, reason=reason)
        return SetParametersResult(successful=True)

    def _refusal(self, parameter: Parameter) -> str:
        if parameter.name == "robot_description":
            if not parameter.value:
                return "Empty URDF is not allowed"
            try:
                # Kept for `_use_parameters`, which need not parse it again.
                self._checked = (parameter.value, parse_description(parameter.value))
            except RobotDescriptionError as error:
                self.get_logger().warning(str(error))
                return str(error)
        if parameter.name == "publish_frequency" and not _is_frequency(parameter.value):
            lowest = "0.0 (exclusive)" if since(LYRICAL) else "0.0"
            return f"publish_frequency must be between {lowest} and 1000.0"
        return ""

    def _use_parameters(self, parameters: Sequence[Parameter]) -> None:
        values = {parameter.name: parameter.value for parameter in parameters}
        if "publish_frequency" in values:
            self._frequency = values["publish_frequency"]
            self._diagnosis.frequency_changed()
        if "ignore_timestamp" in values:
            self._ignores_stamps = values["ignore_timestamp"]
        self._rules_changed()
        if "frame_prefix" in values:
            self._prefix = values["frame_prefix"]
            if self._robot is not None:
                self._use_names(self._robot)
        if "robot_description" in values:
            description, robot = self._checked
            self._start_with(robot, description)

    def _on_joint_state(self, cdr: bytes) -> None:
        """Handle a joint state that the relay left; without a relay, each one."""
        try:
            layout = self._joints.layout_of(cdr)
        except CdrError as error:
            self.get_logger().error(f"Ignoring {error}", throttle_duration_sec=5.0)
            return
        if len(layout.names) != layout.number_of_positions:
            self._refuse(layout)
            return
        now = self.get_clock().now().nanoseconds
        if self._times.moved_back(now):
            self.get_logger().warning("Moved backwards in time, re-publishing joint transforms!")
            self._times.clear()
        self._diagnosis.received(layout.names, layout.knows_a_joint)
        self._publish_unless_skipped(layout, cdr, now)
        if self._relay is not None:
            self._teach(self._relay, layout)

    def _publish_unless_skipped(self, layout: Layout, cdr: bytes, now: int) -> None:
        stamp, interval_ms = stamp_of(cdr), self._interval_ms()
        last = self._times.earliest(layout.names, now)
        if not self._ignores_stamps and stamp < last + interval_ms * 1_000_000:
            if layout.knows_a_joint:
                self._diagnosis.skipped(stamp, last, interval_ms, self._frequency)
            return
        self._dynamic.pub_tf.publish(layout.transforms(cdr))
        self._times.published(layout.names, stamp)

    def _teach(self, relay: JointRelay, layout: Layout) -> None:
        """Have the relay answer joint states of this layout from now on."""
        self._rules_changed()
        # Until then, the diagnosis needs each message.
        if self._diagnosis.is_settled:
            layout.teach(relay)

    def _refuse(self, layout: Layout) -> None:
        if layout.number_of_positions == 0:
            self.get_logger().warning(
                "Robot state publisher ignored a JointState message about joint(s)"
                f' "{printable(layout.names[0])}"(,...) whose position member was empty.'
            )
        else:
            self.get_logger().error("Robot state publisher ignored an invalid JointState message")


def _is_frequency(value: float) -> bool:
    """Return whether a rate [Hz] is accepted; 0 means no limit up to Kilted."""
    return 0.0 <= value <= 1000.0 and not (value == 0.0 and since(LYRICAL))


def _transform(joint: Joint, prefix: str, stamp: Time) -> TransformStamped:
    message = TransformStamped()
    message.header.stamp = stamp
    message.header.frame_id = prefix + joint.parent
    message.child_frame_id = prefix + joint.child
    translation, rotation = message.transform.translation, message.transform.rotation
    translation.x, translation.y, translation.z = joint.origin.xyz
    rotation.x, rotation.y, rotation.z, rotation.w = joint.origin.quaternion
    return message
