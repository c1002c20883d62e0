"""The services and the topic through which other nodes monitor and control a recorder."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosbag2_interfaces import srv
from rosbag2_interfaces.msg import WriteSplitEvent
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from rclpy.node import Node
    from rosbag2_transport.recorder import BagRecorder
    from turtlewire.bag.recording import Recording


class RecorderServices:
    """Answers on the node's executor.

    Args:
        node: The recorder's node.
        recorder: The recorder to control.
        recording: The bag.
        snapshot: Whether there is a service that takes a snapshot.
    """

    def __init__(
        self, node: Node, recorder: BagRecorder, recording: Recording, *, snapshot: bool
    ) -> None:
        self._node = node
        self._recorder = recorder
        self._recording = recording
        self._splits = node.create_publisher(WriteSplitEvent, "events/write_split", 1)
        node.create_service(srv.Pause, "~/pause", self._pause)
        node.create_service(srv.Resume, "~/resume", self._resume)
        node.create_service(srv.IsPaused, "~/is_paused", self._is_paused)
        node.create_service(srv.SplitBagfile, "~/split_bagfile", self._split)
        if snapshot:
            node.create_service(srv.Snapshot, "~/snapshot", self._snapshot)

    def report_split(self, closed_file: str, opened_file: str) -> None:
        """Report to other nodes that a new file has begun."""
        name = self._node.get_fully_qualified_name()
        self._splits.publish(
            WriteSplitEvent(closed_file=closed_file, opened_file=opened_file, node_name=name)
        )

    def _pause(self, _request: Any, response: Any) -> Any:
        self._recorder.pause()
        return response

    def _resume(self, _request: Any, response: Any) -> Any:
        self._recorder.resume()
        return response

    def _is_paused(self, _request: Any, response: Any) -> Any:
        response.paused = self._recorder.is_paused
        return response

    def _split(self, _request: Any, response: Any) -> Any:
        try:
            self.report_split(*self._recording.split())
        except (BagError, OSError) as error:  # the recording ends and reports why
            self._node.get_logger().error(f"The bag file cannot be split: {error}")
        return response

    def _snapshot(self, _request: Any, response: Any) -> Any:
        response.success = self._recording.take_snapshot()
        return response
