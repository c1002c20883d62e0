"""Reads the images of a topic as RGB arrays, a few seconds at a time."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

import av
import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from turtlewire.bag import Bag

WINDOW = 2_000_000_000  # nanoseconds of images that are in memory

_TO_RGB: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "rgb8": lambda pixels: pixels,
    "bgr8": lambda pixels: pixels[..., ::-1],
    "rgba8": lambda pixels: pixels[..., :3],
    "bgra8": lambda pixels: pixels[..., 2::-1],
    "mono8": lambda pixels: np.repeat(pixels[..., None], 3, axis=2),
}


def images_of(bag: Bag, topic: str, recorded_ns: np.ndarray) -> Iterator[np.ndarray]:
    """Yield images of a topic as arrays ``(height, width, 3)``.

    Args:
        bag: The bag.
        topic: A topic of Image or CompressedImage.
        recorded_ns: When the images were recorded, in ascending order. A time may occur several
            times.

    Raises:
        ValueError: The encoding has no colours or grey of 8 bits, such as a depth image.
    """
    convert = _decoded if is_compressed(bag, topic) else _rgb
    for data, encoding in messages_of(bag, topic, recorded_ns):
        yield convert(data, encoding)


def messages_of(bag: Bag, topic: str, recorded_ns: np.ndarray) -> Iterator[tuple[np.ndarray, str]]:
    """Yield the data and the encoding of images, as `images_of` takes them."""
    encoding = "format" if is_compressed(bag, topic) else "encoding"
    begin = 0
    while begin < len(recorded_ns):
        end = int(np.searchsorted(recorded_ns, recorded_ns[begin] + WINDOW))
        times = recorded_ns[begin:end]
        first, last = int(times[0]), int(times[-1])
        table = bag.columns(topic, "data", encoding, start_ns=first, end_ns=last)
        for number in np.searchsorted(table.log_times_ns, times):
            yield table["data"][number], table[encoding][number]
        begin = end


def is_compressed(bag: Bag, topic: str) -> bool:
    """Return True if the topic has images as JPEG or PNG."""
    return bag.topics[topic].type == "sensor_msgs/msg/CompressedImage"


def _rgb(pixels: np.ndarray, encoding: str) -> np.ndarray:
    if encoding not in _TO_RGB:
        raise ValueError(f"no video of {encoding} images; possible are {', '.join(_TO_RGB)}")
    return _TO_RGB[encoding](pixels)


def _decoded(data: np.ndarray, _format: str) -> Any:
    with av.open(io.BytesIO(data.tobytes())) as file:
        return next(file.decode(video=0)).to_ndarray(format="rgb24")
