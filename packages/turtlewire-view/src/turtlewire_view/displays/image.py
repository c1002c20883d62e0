"""Image and CompressedImage: pictures that the page shows in a window over the scene."""

from __future__ import annotations

from typing import Any

import numpy as np

from turtlewire_view.displays.content import Content, Display, Output, UnusableMessageError
from turtlewire_view.displays.encodings import rgba_of

__all__ = ["CompressedImageDisplay", "ImageDisplay"]

#: Longest side of a picture that is sent [pixels].
_LARGEST_SIDE = 960
_SIGNATURES = {b"\xff\xd8\xff": "image/jpeg", b"\x89PNG\r\n\x1a\n": "image/png"}
#: Bytes before the PNG in messages of compressed_depth_image_transport.
_DEPTH_HEADER = 12
_MOST_PIXELS = 64 * 10**6
_LARGEST_FILE = 32 * 2**20


class ImageDisplay(Display):
    """The pixels of a ``sensor_msgs/msg/Image`` as RGBA, at most 960 a side.

    Options: ``normalize_range``, ``min``, ``max``, see
    :func:`turtlewire_view.displays.encodings.rgba_of`.
    """

    kind = "image"
    replays = True

    def _outputs(self, message: Any) -> list[Output]:
        rgba = rgba_of(message, self.options, _LARGEST_SIDE)
        header = {
            "encoding": message.encoding,
            "width": message.width,
            "height": message.height,
            "camera": message.header.frame_id,
        }
        return [Content(header, {"rgba": rgba})]


class CompressedImageDisplay(Display):
    """The file in a ``sensor_msgs/msg/CompressedImage``: the browser decodes JPEG and PNG."""

    kind = "image"
    replays = True

    def _outputs(self, message: Any) -> list[Output]:
        data = bytes(message.data[: _LARGEST_FILE + 1])
        if len(data) > _LARGEST_FILE:
            raise UnusableMessageError(f"{len(message.data)} bytes are too many for one image")
        media_type = _media_type(data)
        if media_type is None and "compressedDepth" in message.format:
            data = data[_DEPTH_HEADER:]
            media_type = _media_type(data)
        if media_type is None:
            raise UnusableMessageError(
                f"format '{message.format}': the {len(data)} bytes are neither JPEG nor PNG"
            )
        if media_type == "image/png":
            _check_size(data)
        header = {
            "encoding": message.format,
            "media_type": media_type,
            "camera": message.header.frame_id,
        }
        return [Content(header, {"file": np.frombuffer(data, np.uint8)})]


def _check_size(png: bytes) -> None:
    """Refuse a PNG that would fill the browser's memory: its first chunk has the size."""
    width, height = int.from_bytes(png[16:20], "big"), int.from_bytes(png[20:24], "big")
    if width * height > _MOST_PIXELS:
        raise UnusableMessageError(f"a PNG of {width} x {height} pixels is too large")


def _media_type(data: bytes) -> str | None:
    return next((kind for start, kind in _SIGNATURES.items() if data.startswith(start)), None)
