"""Runs a MuJoCo model as a robot: transforms, joint states, the clock and a camera.

The program imports only packages that a real ROS 2 has as well, and MuJoCo.
"""

from __future__ import annotations

import array
import ctypes.util
import math
import os
import sys
from pathlib import Path

import numpy as np

import rclpy
from builtin_interfaces.msg import Time
from geometry_msgs.msg import TransformStamped
from rclpy.clock import Clock, ClockType
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rosgraph_msgs.msg import Clock as ClockMessage
from sensor_msgs.msg import CameraInfo, Image, JointState
from std_msgs.msg import Float64MultiArray
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

# MuJoCo reads this when it is imported. EGL renders without a screen.
if sys.platform == "linux":
    os.environ.setdefault("MUJOCO_GL", "egl" if ctypes.util.find_library("EGL") else "disable")

import mujoco

PERIOD = 0.02  # simulated seconds between two states
TICKS_PER_IMAGE = 5
WIDTH, HEIGHT = 320, 240  # of the image, in pixels
ARM = Path(__file__).with_name("arm.xml")


def transform(parent: str, child: str, position: np.ndarray, wxyz: np.ndarray) -> TransformStamped:
    """Return a transform without a stamp from MuJoCo's position and quaternion."""
    made = TransformStamped(child_frame_id=child)
    made.header.frame_id = parent
    to = made.transform
    to.translation.x, to.translation.y, to.translation.z = position.tolist()
    # MuJoCo stores quaternions as w, x, y, z; ROS 2 as x, y, z, w.
    to.rotation.w, to.rotation.x, to.rotation.y, to.rotation.z = wxyz.tolist()
    return made


class MujocoRobot(Node):
    """Steps the model in real time, or `speed` times as fast, and publishes its state."""

    def __init__(self) -> None:
        super().__init__("mujoco_robot")
        path = self.declare_parameter("model", str(ARM)).value
        speed = self.declare_parameter("speed", 1.0).value
        self.model = mujoco.MjModel.from_xml_path(path)
        self.data = mujoco.MjData(self.model)
        mujoco.mj_forward(self.model, self.data)
        self._time = self.create_publisher(ClockMessage, "/clock", 1)
        self._joint_states = self.create_publisher(JointState, "joint_states", 10)
        self._broadcaster = TransformBroadcaster(self)
        self._static_broadcaster = StaticTransformBroadcaster(self)
        self._ticks = 0
        self._choose_bodies_and_joints()
        self._camera = self._open_camera() if self.declare_parameter("camera", True).value else None
        self._static_broadcaster.sendTransform(self._static_transforms())
        topic = "forward_position_controller/commands"
        self.create_subscription(Float64MultiArray, topic, self._on_command, 10)
        # This node publishes the simulated time, so the timer must follow another clock.
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(PERIOD / speed, self._on_timer, clock=steady)
        self.get_logger().info(
            f"simulating {path}: bodies {self.model.nbody - 1}, joints {len(self._joints)}, "
            f"actuators {self.model.nu}, camera {'no' if self._camera is None else 'yes'}"
        )

    def _choose_bodies_and_joints(self) -> None:
        model = self.model
        moves = (model.body_dofnum > 0) | (model.body_mocapid >= 0)
        self._moving = [body for body in range(1, model.nbody) if moves[body]]  # 0 is the world
        self._fixed = [body for body in range(1, model.nbody) if not moves[body]]
        # Free and ball joints have several positions; only the transforms show them.
        scalar = [int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE)]
        self._joints = np.flatnonzero(np.isin(model.jnt_type, scalar)).tolist()

    def _open_camera(self) -> Camera | None:
        if self.model.ncam == 0:
            return None
        try:
            return Camera(self)
        except (AttributeError, ImportError, RuntimeError, mujoco.FatalError) as error:
            library = os.environ.get("MUJOCO_GL", "its default")
            self.get_logger().warning(
                f"no camera image: MuJoCo cannot render with MUJOCO_GL={library} "
                f"({error}). On Debian and Ubuntu: apt install libegl1 libgl1-mesa-dri"
            )
            return None

    def close_camera(self) -> None:
        """Free the OpenGL context: MuJoCo 3 cannot free it while Python exits."""
        if self._camera is not None:
            self._camera.renderer.close()

    def _on_command(self, command: Float64MultiArray) -> None:
        if len(command.data) != self.model.nu:
            self.get_logger().error(
                f"expected {self.model.nu} numbers, one for each actuator, "
                f"got {len(command.data)}; the command is ignored"
            )
            return
        self.data.ctrl[:] = command.data

    def _on_timer(self) -> None:
        mujoco.mj_step(self.model, self.data, max(1, round(PERIOD / self.model.opt.timestep)))
        # A step computes the poses of the bodies before it moves the joints.
        mujoco.mj_forward(self.model, self.data)
        seconds, rest = divmod(round(self.data.time * 1e9), 1_000_000_000)
        stamp = Time(sec=seconds, nanosec=rest)
        self._time.publish(ClockMessage(clock=stamp))
        self._publish_state(stamp)
        if self._camera is not None and self._ticks % TICKS_PER_IMAGE == 0:
            self._camera.publish(stamp)
        self._ticks += 1

    def _publish_state(self, stamp: Time) -> None:
        data, model = self.data, self.model
        positions, speeds = model.jnt_qposadr[self._joints], model.jnt_dofadr[self._joints]
        state = JointState(
            name=[model.joint(joint).name or f"joint_{joint}" for joint in self._joints],
            position=data.qpos[positions].tolist(),
            velocity=data.qvel[speeds].tolist(),
            effort=data.qfrc_actuator[speeds].tolist(),
        )
        state.header.stamp = stamp
        self._joint_states.publish(state)
        transforms = [self._transform_of(body) for body in self._moving]
        for moved in transforms:
            moved.header.stamp = stamp
        self._broadcaster.sendTransform(transforms)

    def frame(self, body: int) -> str:
        """Return the name of the frame of a body."""
        return self.model.body(body).name or f"body_{body}"

    def _transform_of(self, body: int) -> TransformStamped:
        """Return the pose of a body in the frame of its parent."""
        data, parent = self.data, self.model.body_parentid[body]
        inverse, pose = (np.zeros(3), np.zeros(4)), (np.zeros(3), np.zeros(4))
        mujoco.mju_negPose(*inverse, data.xpos[parent], data.xquat[parent])
        mujoco.mju_mulPose(*pose, *inverse, data.xpos[body], data.xquat[body])
        return transform(self.frame(parent), self.frame(body), *pose)

    def _static_transforms(self) -> list[TransformStamped]:
        fixed = [self._transform_of(body) for body in self._fixed]
        return [*fixed, self._camera.transform()] if self._camera is not None else fixed


class Camera:
    """The first camera of the model, as ROS 2's camera drivers publish it."""

    def __init__(self, robot: MujocoRobot) -> None:
        self._robot = robot
        self.renderer = mujoco.Renderer(robot.model, HEIGHT, WIDTH)
        self._frame = (robot.model.camera(0).name or "camera") + "_optical_frame"
        self._images = robot.create_publisher(Image, "camera/image_raw", qos_profile_sensor_data)
        self._infos = robot.create_publisher(
            CameraInfo, "camera/camera_info", qos_profile_sensor_data
        )

    def transform(self) -> TransformStamped:
        """Return the pose of the optical frame in its body.

        A camera of MuJoCo looks along -z with y up. An optical frame of ROS looks along z with y
        down: half a turn about x lies between them.
        """
        model, wxyz = self._robot.model, np.zeros(4)
        mujoco.mju_mulQuat(wxyz, model.cam_quat[0], np.array([0.0, 1.0, 0.0, 0.0]))
        return transform(
            self._robot.frame(model.cam_bodyid[0]), self._frame, model.cam_pos[0], wxyz
        )

    def publish(self, stamp: Time) -> None:
        """Render and publish an image and the calibration."""
        self.renderer.update_scene(self._robot.data, camera=0)
        pixels = array.array("B", self.renderer.render().tobytes())
        image = Image(height=HEIGHT, width=WIDTH, encoding="rgb8", step=3 * WIDTH, data=pixels)
        focal = HEIGHT / 2 / math.tan(math.radians(self._robot.model.cam_fovy[0]) / 2)
        x, y = (WIDTH - 1) / 2, (HEIGHT - 1) / 2
        info = CameraInfo(height=HEIGHT, width=WIDTH, distortion_model="plumb_bob", d=[0.0] * 5)
        info.k = [focal, 0.0, x, 0.0, focal, y, 0.0, 0.0, 1.0]
        info.r = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
        info.p = [focal, 0.0, x, 0.0, 0.0, focal, y, 0.0, 0.0, 0.0, 1.0, 0.0]
        for message in (image, info):
            message.header.stamp, message.header.frame_id = stamp, self._frame
        self._images.publish(image)
        self._infos.publish(info)


def main() -> None:
    """Simulate until Ctrl-C."""
    rclpy.init()
    try:
        robot = MujocoRobot()
    except ValueError as error:  # MuJoCo's, for a model that it cannot read
        rclpy.try_shutdown()
        sys.exit(str(error))
    try:
        rclpy.spin(robot)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        robot.close_camera()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
