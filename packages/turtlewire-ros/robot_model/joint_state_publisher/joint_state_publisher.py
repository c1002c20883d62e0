"""The node that publishes ``joint_states`` at a fixed rate."""

from __future__ import annotations

import argparse
import contextlib
import sys
from collections.abc import Callable
from typing import Any

import rclpy
from joint_state_publisher.description import DescriptionError, JointOptions, read_joints
from joint_state_publisher.joints import JointSet, MimicLoopError, MimicRule, State
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.utilities import remove_ros_args
from sensor_msgs.msg import JointState
from std_msgs.msg import String

_DEPTH = 10
_ALLOWED = ("parent", "factor", "offset")


class SettingError(ValueError):
    """A parameter or the file on the command line cannot be used."""


class LoggedError(SettingError):
    """A setting is wrong, and the node has logged it."""


class JointStatePublisher(Node):
    """Publishes the joints' values at ``rate``; learns them from ``robot_description``.

    Args:
        description_file: A URDF file to use instead of the topic; None: wait for the topic.
        **options: As for :class:`rclpy.node.Node`.

    Raises:
        SettingError: A parameter is wrong, or the file cannot be read or used.

    Attributes:
        joints: The joints with their present values; empty until there is a description.
    """

    def __init__(self, description_file: str | None = None, **options: Any) -> None:
        super().__init__(
            "joint_state_publisher", automatically_declare_parameters_from_overrides=True, **options
        )
        self.joints = JointSet()
        self._delta = self._number("delta", 0.0)
        self._options = self._read_options()
        sources = self._sources()
        self.rate = self._number("rate", 10)
        if not self.rate > 0:
            raise SettingError(f"the parameter 'rate' must be greater than 0, got {self.rate:g}")
        if description_file is not None:
            self._load(description_file)
        self._publisher = self.create_publisher(JointState, "joint_states", _DEPTH)
        # Like the publisher's: the description was sent before this node subscribed.
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(String, "robot_description", self._on_description, latched)
        for topic in sources:
            self.create_subscription(JointState, topic, self._on_source, _DEPTH)
        if description_file is None:
            self.get_logger().info(
                "Waiting for robot_description to be published on the robot_description topic..."
            )
        self.create_timer(1.0 / self.rate, self._on_timer)

    def joints_changed(self) -> None:
        """Called on the executor's thread when there are other joints. For subclasses."""

    def values_changed(self) -> None:
        """Called on the executor's thread when values may have changed. For subclasses."""

    def advance(self) -> None:
        """Move the joints before they are published: by ``delta``, if that is set."""
        if self._delta > 0:
            self.joints.sweep(self._delta)

    def publish(self) -> None:
        """Publish the present values, unless there are no joints yet.

        As in ROS 2, dependent joints that parameters define count before there is a description:
        then the message has their number of zeros and no names.
        """
        state = self.joints.state()
        if not state.names:
            if not self._options.mimics or not self._options.positions:
                return
            state = State([], [0.0] * len(self._options.mimics), [], [])
        message = JointState(
            name=state.names,
            position=state.positions,
            velocity=state.velocities,
            effort=state.efforts,
        )
        message.header.stamp = self.get_clock().now().to_msg()
        self._publisher.publish(message)

    def _setting(self, name: str, default: Any) -> Any:
        if not self.has_parameter(name):
            self.declare_parameter(name, default)
        return self.get_parameter(name).value

    def _number(self, name: str, default: float) -> float:
        return _as_number(name, self._setting(name, default))

    def _switch(self, name: str, default: bool) -> bool:
        value = self._setting(name, default)
        if not isinstance(value, bool):
            raise SettingError(f"the parameter '{name}' must be true or false, got {value!r}")
        return value

    def _sources(self) -> list[str]:
        name = "source_list"
        if not self.has_parameter(name):  # an empty list as default would not say of what
            self.declare_parameter(name, Parameter.Type.STRING_ARRAY)
        return self.get_parameter_or(name).value or []

    def _read_options(self) -> JointOptions:
        zeros = {
            name: _as_number(f"zeros.{name}", parameter.value)
            for name, parameter in self.get_parameters_by_prefix("zeros").items()
        }
        return JointOptions(
            zeros,
            _dependent_joints(self.get_parameters_by_prefix("dependent_joints")),
            use_mimic_tags=self._switch("use_mimic_tags", True),
            use_smallest_limits=self._switch("use_smallest_joint_limits", True),
            positions=self._switch("publish_default_positions", True),
            velocities=self._switch("publish_default_velocities", False),
            efforts=self._switch("publish_default_efforts", False),
        )

    def _load(self, path: str) -> None:
        try:
            with open(path, encoding="utf-8") as file:
                self._take_description(file.read())
        except OSError as error:
            raise SettingError(f"cannot read the file {path!r}: {error.strerror}") from error
        except UnicodeDecodeError as error:
            raise SettingError(f"the file {path!r} is not text: {error}") from error
        except DescriptionError as error:
            raise SettingError(str(error)) from error

    def _take_description(self, text: str) -> None:
        """Learn the joints of a description.

        Raises:
            DescriptionError: The description is invalid; the joints stay unchanged.
            LoggedError: The description is rejected, because joints mimic each other in a cycle.
        """
        joints = read_joints(text, self._options, self._warn)
        try:
            # Raises if joints mimic each other in a cycle; the joints in use are replaced only
            # below.
            joints.state()
        except MimicLoopError as error:
            self.get_logger().error(str(error))
            raise LoggedError(str(error)) from error
        self.joints = joints
        self.joints_changed()

    def _warn(self, text: str) -> None:
        self.get_logger().warning(text)

    def _on_description(self, message: String) -> None:
        try:
            with contextlib.suppress(LoggedError):
                self._take_description(message.data)
        except DescriptionError as error:
            self.get_logger().warning(str(error))

    def _on_source(self, message: JointState) -> None:
        try:
            self.joints.take(message.name, message.position, message.velocity, message.effort)
        except ValueError as error:
            self.get_logger().warning(f"Ignored a JointState message: {error}")
            return
        self.values_changed()

    def _on_timer(self) -> None:
        self.advance()
        self.publish()
        self.values_changed()


def _dependent_joints(parameters: dict[str, Any]) -> dict[str, MimicRule]:
    settings: dict[str, dict[str, Any]] = {}
    for full_name, parameter in parameters.items():
        joint, _, key = full_name.rpartition(".")
        if key not in _ALLOWED:
            allowed = ", ".join(f"'{name}'" for name in _ALLOWED)
            raise SettingError(
                f"Invalid dependent_joint name '{key}' (allowed values are {allowed})"
            )
        settings.setdefault(joint, {})[key] = parameter.value
    if any("parent" not in setting for setting in settings.values()):
        raise SettingError("All dependent_joints must at least have a parent")
    return {
        joint: MimicRule(
            str(setting["parent"]),
            _as_number(f"dependent_joints.{joint}.factor", setting.get("factor", 1)),
            _as_number(f"dependent_joints.{joint}.offset", setting.get("offset", 0)),
        )
        for joint, setting in settings.items()
    }


def _as_number(name: str, value: object) -> float:
    # In Python, a bool is an int.
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise SettingError(f"the parameter '{name}' must be a number, got {value!r}")
    return float(value)


def run(
    make_node: Callable[..., Node],
    args: list[str] | None = None,
    *,
    add_options: Callable[[argparse.ArgumentParser], object] | None = None,
) -> int:
    """Read the command line, make the node and spin it until Ctrl-C; returns the exit status."""
    parser = argparse.ArgumentParser(description="Publish the states of a robot's joints.")
    parser.add_argument(
        "description_file",
        nargs="?",
        help="a URDF file; without it, the node waits for the topic robot_description",
    )
    if add_options is not None:
        add_options(parser)
    # `rclpy.init` reads the ROS arguments; argparse would reject them.
    argv = remove_ros_args(sys.argv if args is None else ["", *args])
    options = parser.parse_args(argv[1:])
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        try:
            node = make_node(**vars(options))
        except LoggedError:
            return 1
        except SettingError as error:
            print(f"Exception: {error}", file=sys.stderr)  # noqa: T201 - as ROS 2's last line
            return 1
        try:
            rclpy.spin(node)
        finally:
            node.destroy_node()
    return 0


def main(args: list[str] | None = None) -> int:
    """Publish joint states until Ctrl-C."""
    return run(JointStatePublisher, args)
