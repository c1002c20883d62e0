"""Serves interactive markers to 3D views and receives the feedback of their users."""

from __future__ import annotations

import copy
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from builtin_interfaces.msg import Time as TimeMessage
from rclpy.duration import Duration
from visualization_msgs.msg import (
    InteractiveMarker,
    InteractiveMarkerFeedback,
    InteractiveMarkerPose,
    InteractiveMarkerUpdate,
)
from visualization_msgs.srv import GetInteractiveMarkers

if TYPE_CHECKING:
    from geometry_msgs.msg import Pose
    from rclpy.node import Node
    from rclpy.qos import QoSProfile
    from rclpy.time import Time
    from std_msgs.msg import Header

    Callback = Callable[[InteractiveMarkerFeedback], object]

__all__ = ["InteractiveMarkerServer"]

#: The client that moved a marker last keeps exclusive control of it for this time.
_GRIP = Duration(seconds=1)


class _Grip(NamedTuple):
    """The client that moved a marker last, and the time of that."""

    client: str
    time: Time


class InteractiveMarkerServer:
    """Offers a set of interactive markers to the 3D views on the network.

    Views see a change after `applyChanges`, which sends all changes since the last one together.
    Callbacks take effect at once.

    Args:
        node: The node, whose executor runs the callbacks.
        namespace: Where the views look for the markers: on ``NAMESPACE/update`` and
            ``NAMESPACE/feedback``, and with the service ``NAMESPACE/get_interactive_markers``.
        q_size: The number of updates that are kept for a slow view.
        update_pub_qos: The QoS of the updates; by default, reliable with the depth ``q_size``.
        feedback_sub_qos: The QoS of the feedback, or its depth.
    """

    #: The key of the callback for all types of feedback without a specific one.
    DEFAULT_FEEDBACK_CALLBACK = 255

    def __init__(
        self,
        node: Node,
        namespace: str,
        q_size: int = 100,
        *,
        update_pub_qos: QoSProfile | None = None,
        feedback_sub_qos: QoSProfile | int = 1,
    ) -> None:
        self.node = node
        self.namespace = namespace
        self.seq_num = 0
        self._lock = threading.Lock()
        # The markers as views show them, and after pending updates; none is changed in place.
        self._shown: dict[str, InteractiveMarker] = {}
        self._wanted: dict[str, InteractiveMarker] = {}
        # The names of the markers in which these differ; False if only in the pose.
        self._changed: dict[str, bool] = {}
        self._callbacks: dict[str, dict[int, Callback]] = {}
        self._grips: dict[str, _Grip] = {}
        self.update_pub = node.create_publisher(
            InteractiveMarkerUpdate, f"{namespace}/update", update_pub_qos or q_size
        )
        self.feedback_sub = node.create_subscription(
            InteractiveMarkerFeedback,
            f"{namespace}/feedback",
            self.processFeedback,
            feedback_sub_qos,
        )
        self.get_interactive_markers_srv = node.create_service(
            GetInteractiveMarkers, f"{namespace}/get_interactive_markers", self._on_get
        )

    def shutdown(self) -> None:
        """Remove all markers from the views."""
        self.clear()
        self.applyChanges()

    def insert(
        self,
        marker: InteractiveMarker,
        *,
        feedback_callback: Callback | None = None,
        feedback_type: int = DEFAULT_FEEDBACK_CALLBACK,
    ) -> None:
        """Add a marker, or replace the one of this name, which keeps its callbacks.

        Args:
            marker: The marker, of which the server keeps a copy.
            feedback_callback: As for `setCallback`; None changes no callback.
            feedback_type: As for `setCallback`.
        """
        with self._lock:
            self._wanted[marker.name] = copy.deepcopy(marker)
            self._changed[marker.name] = True
        if feedback_callback is not None:
            self.setCallback(marker.name, feedback_callback, feedback_type)

    def setPose(  # noqa: N802  ROS 2's name
        self, name: str, pose: Pose, header: Header | None = None
    ) -> bool:
        """Move a marker; returns False if the name is unknown.

        Args:
            name: Name of the marker.
            pose: Its pose.
            header: The frame and stamp of the pose; the marker's if this frame is empty.
        """
        with self._lock:
            return self._set_pose(name, pose, header)

    def _set_pose(self, name: str, pose: Pose, header: Header | None) -> bool:
        marker = self._wanted.get(name)
        if marker is None:
            return False
        moved = copy.copy(marker)
        moved.pose = copy.deepcopy(pose)
        if header is not None and header.frame_id:
            moved.header = copy.deepcopy(header)
        self._wanted[name] = moved
        self._changed.setdefault(name, False)
        return True

    def erase(self, name: str) -> bool:
        """Remove a marker; returns False if the name is unknown."""
        with self._lock:
            if self._wanted.pop(name, None) is None:
                return False
            self._changed[name] = True
            return True

    def clear(self) -> None:
        """Remove all markers."""
        with self._lock:
            self._changed.update(dict.fromkeys(self._wanted, True))
            self._wanted.clear()

    def get(self, name: str) -> InteractiveMarker | None:
        """Return a copy of a marker as it will be after `applyChanges`; None if it is unknown."""
        with self._lock:
            return copy.deepcopy(self._wanted.get(name))

    def setCallback(  # noqa: N802  ROS 2's name
        self,
        name: str,
        feedback_callback: Callback | None,
        feedback_type: int = DEFAULT_FEEDBACK_CALLBACK,
    ) -> bool:
        """Set the callback for feedback of users; returns False for an unknown marker.

        Args:
            name: Name of the marker.
            feedback_callback: Called with the feedback; None removes the callback.
            feedback_type: An ``event_type`` of ``InteractiveMarkerFeedback``; by default, all that
                have no callback of their own.
        """
        with self._lock:
            if name not in self._wanted:
                return False
            callbacks = self._callbacks.setdefault(name, {})
            if feedback_callback is None:
                callbacks.pop(feedback_type, None)
            else:
                callbacks[feedback_type] = feedback_callback
            return True

    def applyChanges(self) -> None:  # noqa: N802  ROS 2's name
        """Send all changes since the last call to the views, if there are any."""
        with self._lock:
            if not self._changed:
                return
            self.seq_num += 1
            update = self._update()
            self._changed.clear()
            self._shown = dict(self._wanted)
            # Within the lock: updates leave in the order of their numbers.
            self.update_pub.publish(update)

    def _update(self) -> InteractiveMarkerUpdate:
        update = InteractiveMarkerUpdate(
            server_id=self.namespace, seq_num=self.seq_num, type=InteractiveMarkerUpdate.UPDATE
        )
        for name, is_whole in self._changed.items():
            marker = self._wanted.get(name)
            if marker is None:
                self._callbacks.pop(name, None)
                self._grips.pop(name, None)
                update.erases.append(name)
            elif is_whole:
                update.markers.append(marker)
            else:
                update.poses.append(
                    InteractiveMarkerPose(header=marker.header, pose=marker.pose, name=name)
                )
        return update

    def processFeedback(self, feedback: InteractiveMarkerFeedback) -> None:  # noqa: N802  ROS 2's name
        """Apply a user's feedback to its marker, and call the marker's callback."""
        name = feedback.marker_name
        with self._lock:
            marker = self._shown.get(name)
            if marker is None:
                return
            if not self._grips_marker(feedback):
                self.node.get_logger().debug(
                    f"Rejecting feedback for {name}: conflicting feedback from separate clients."
                )
                return
            if feedback.event_type == InteractiveMarkerFeedback.POSE_UPDATE:
                # A marker without a stamp follows its frame, whatever the view's frame is.
                is_fixed = marker.header.stamp != TimeMessage()
                self._set_pose(name, feedback.pose, feedback.header if is_fixed else None)
            callbacks = self._callbacks.get(name, {})
            callback = callbacks.get(
                feedback.event_type, callbacks.get(self.DEFAULT_FEEDBACK_CALLBACK)
            )
        if callback is not None:
            callback(feedback)

    def _grips_marker(self, feedback: InteractiveMarkerFeedback) -> bool:
        """Give a client control of the marker; returns False if another client still has it."""
        now = self.node.get_clock().now()
        last = self._grips.get(feedback.marker_name)
        if last and last.client != feedback.client_id and now - last.time < _GRIP:
            return False
        self._grips[feedback.marker_name] = _Grip(feedback.client_id, now)
        return True

    def _on_get(
        self, _request: GetInteractiveMarkers.Request, response: GetInteractiveMarkers.Response
    ) -> GetInteractiveMarkers.Response:
        with self._lock:
            response.sequence_number = self.seq_num
            response.markers = list(self._shown.values())
        return response
