"""Images of cameras in the scene: the page draws the scene over each, as the camera sees it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from turtlewire_view.displays.camera_model import CAMERA_INFO, info_topic, projection_of
from turtlewire_view.displays.content import (
    Content,
    Display,
    Output,
    Status,
    UnusableMessageError,
    frame_of,
    stamp_ns_of,
)
from turtlewire_view.displays.image import CompressedImageDisplay, ImageDisplay

if TYPE_CHECKING:
    from collections.abc import Collection

__all__ = ["CameraDisplay", "CompressedCameraDisplay"]


class _ThroughCamera(Display):
    """An image, with the projection of the CameraInfo next to it.

    The content lies in the frame of the image; its header has ``projection``: ``fx``, ``fy``,
    ``cx``, ``cy``, ``width`` and ``height`` in pixels, ``tx`` and ``ty`` in metres.
    """

    kind = "camera"
    _info: Any = None
    _image: Any = None

    @classmethod
    def suits(cls, topic: str, names: Collection[str]) -> bool:
        """Return True if there is a CameraInfo next to the image."""
        return info_topic(topic) in names

    def topics(self, type_name: str) -> dict[str, str]:
        """Return the topics of the image and of its CameraInfo."""
        return {self.topic: type_name, info_topic(self.topic): CAMERA_INFO}

    def take(self, topic: str, message: Any) -> list[Output]:
        """Return the image when it has come and when its CameraInfo has changed."""
        if topic == self.topic:
            self._image = message
        elif _has_same_numbers(message, self._info):
            return []
        else:
            self._info = message
        if self._info is None:
            text = f"No CameraInfo received on [{info_topic(self.topic)}]"
            return [Status.of("warn", text)]
        if self._image is None:
            return []
        return self.content(self._image)

    def _outputs(self, message: Any) -> list[Output]:
        projection = projection_of(self._info)
        outputs: list[Output] = []
        for output in super()._outputs(message):
            assert isinstance(output, Content)
            size = {name: output.header.get(name, 0) for name in ("width", "height")}
            numbers = {**projection._asdict()}
            for name, there in size.items():
                numbers[name] = numbers[name] or there
            if not (numbers["width"] and numbers["height"]):
                raise UnusableMessageError("the width or height of the CameraInfo is 0")
            header = {**output.header, "projection": numbers}
            frame_id, stamp_ns = frame_of(message), stamp_ns_of(message)
            outputs.append(replace(output, header=header, frame_id=frame_id, stamp_ns=stamp_ns))
        return outputs


class CameraDisplay(_ThroughCamera, ImageDisplay):
    """A ``sensor_msgs/msg/Image`` with the scene over it; options as for images."""

    kind = "camera"


class CompressedCameraDisplay(_ThroughCamera, CompressedImageDisplay):
    """A ``sensor_msgs/msg/CompressedImage`` with the scene over it."""

    kind = "camera"


def _has_same_numbers(info: Any, former: Any) -> bool:
    if former is None:
        return False
    return bool(
        (info.width, info.height) == (former.width, former.height)
        and list(info.p) == list(former.p)
        and list(info.k) == list(former.k)
    )
