"""Image and CompressedImage: pictures that the page shows in a window over the scene."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire_view.displays.content import Content, Display, Output, UnusableMessageError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlewire_view.displays.options import DisplayOptions

__all__ = [
    "ENCODINGS",
    "CompressedImageDisplay",
    "ImageDisplay",
    "pixels_of",
    "rgba_of",
]

#: Channels of the colours in the order of the bytes.
_COLORS = {
    "rgb8": "rgb",
    "bgr8": "bgr",
    "rgba8": "rgba",
    "bgra8": "bgra",
    "8UC3": "bgr",
    "8UC4": "bgra",
    "rgb16": "rgb",
    "bgr16": "bgr",
    "rgba16": "rgba",
    "bgra16": "bgra",
}
_GREY = {"mono8": "u1", "8UC1": "u1", "mono16": "u2", "16UC1": "u2", "32FC1": "f4", "64FC1": "f8"}
#: Where Y, U and V lie in the four bytes of two pixels: first Y, second Y, U, V.
_YUV422 = {
    "uyvy": (1, 3, 0, 2),
    "yuv422": (1, 3, 0, 2),
    "yuyv": (0, 2, 1, 3),
    "yuv422_yuy2": (0, 2, 1, 3),
}
_BAYER = re.compile(r"bayer_(rggb|bggr|gbrg|grbg)(8|16)")

ENCODINGS = (*_COLORS, *_GREY, *_YUV422, "bayer_*8", "bayer_*16")


def rgba_of(message: Any, options: DisplayOptions, largest: int) -> NDArray[np.uint8]:
    """Return the picture of an Image message, ``(height, width, 4)``.

    It is made coarser so that neither side is longer than ``largest``; a Bayer pattern gives one
    pixel for each of its blocks.

    Options: ``normalize_range`` (true) spreads depths and other values without a fixed range over
    their least and greatest; else ``min`` and ``max`` bound them.

    Raises:
        UnusableMessageError: The encoding is unknown, or bytes are missing.
    """
    encoding = message.encoding
    step = max(1, -(-max(message.width, message.height) // largest))
    if encoding in _COLORS:
        return _colors(message, _COLORS[encoding], step)
    if encoding in _GREY:
        return _grey(pixels_of(message, _GREY[encoding], 1)[::step, ::step, 0], encoding, options)
    if encoding in _YUV422:
        return _yuv422(message, _YUV422[encoding], step)
    bayer = _BAYER.fullmatch(encoding)
    if bayer is not None:
        return _bayer(message, bayer[1], int(bayer[2]) // 8, step)
    raise UnusableMessageError(
        f"the encoding '{encoding}' is not supported; choose from {', '.join(ENCODINGS)}"
    )


def pixels_of(message: Any, code: str, channels: int) -> NDArray[Any]:
    """Return the pixels of an Image without the padding of rows, ``(height, width, channels)``.

    Args:
        message: The Image.
        code: NumPy's code of a number of a pixel, without byte order.
        channels: How many numbers a pixel has.

    Raises:
        UnusableMessageError: The image has no pixels, or bytes are missing.
    """
    size = int(code[1])
    height, width, row = message.height, message.width, message.step
    used = width * channels * size
    if not width or not height:
        raise UnusableMessageError(f"the image has no pixels: {width} x {height}")
    if row < used:
        raise UnusableMessageError(f"step is {row}, but a row of {message.encoding} needs {used}")
    needed = (height - 1) * row + used
    if len(message.data) < needed:
        raise UnusableMessageError(
            f"{width} x {height} pixels of {message.encoding} need {needed} bytes, "
            f"the image holds {len(message.data)}"
        )
    order = ">" if message.is_bigendian else "<"
    pixels: NDArray[Any] = np.ndarray(
        (height, width, channels),
        np.dtype(order + code),
        np.frombuffer(message.data, np.uint8).data,
        strides=(row, channels * size, size),
    )
    return pixels


def _colors(message: Any, order: str, step: int) -> NDArray[np.uint8]:
    wide = message.encoding.endswith("16")
    pixels = pixels_of(message, "u2" if wide else "u1", len(order))[::step, ::step]
    if wide:
        pixels = pixels >> 8
    rgba = np.full((*pixels.shape[:2], 4), 255, dtype=np.uint8)
    for channel, name in enumerate(order):
        rgba[..., "rgba".index(name)] = pixels[..., channel]
    return rgba


def _grey(pixels: NDArray[Any], encoding: str, options: DisplayOptions) -> NDArray[np.uint8]:
    if encoding in {"mono8", "8UC1"}:
        levels = pixels.astype(np.uint8)
    elif encoding == "mono16":
        levels = (pixels >> 8).astype(np.uint8)
    else:
        levels = _normalized(pixels.astype(np.float64), options)
    rgba = np.repeat(levels[..., None], 4, axis=2)
    rgba[..., 3] = 255
    return rgba


def _normalized(values: NDArray[np.float64], options: DisplayOptions) -> NDArray[np.uint8]:
    finite = np.isfinite(values)
    low, high = options.number("min"), options.number("max")
    if options.flag("normalize_range") and finite.any():
        low, high = float(values[finite].min()), float(values[finite].max())
    span = high - low if high > low else 1.0
    with np.errstate(over="ignore", invalid="ignore"):
        levels = np.clip((np.where(finite, values, low) - low) / span, 0.0, 1.0)
    return np.rint(np.nan_to_num(levels) * 255).astype(np.uint8)


def _yuv422(message: Any, places: tuple[int, ...], step: int) -> NDArray[np.uint8]:
    """Two pixels share their colour (ITU-R BT.601, full range)."""
    pairs = pixels_of(message, "u1", 2)
    even = pairs.shape[1] // 2 * 2
    if not even:
        raise UnusableMessageError(f"{message.encoding} needs two pixels in a row, there is one")
    blocks = pairs[::step, :even].reshape(-1, even // 2, 4).astype(np.float64)
    first, second, u, v = (blocks[..., place] for place in places)
    light = np.stack([first, second], axis=2).reshape(len(blocks), even)[:, ::step]
    u, v = (np.repeat(part - 128.0, 2, axis=1)[:, ::step] for part in (u, v))
    rgb = [light + 1.402 * v, light - 0.344136 * u - 0.714136 * v, light + 1.772 * u]
    rgba = np.full((*light.shape, 4), 255, dtype=np.uint8)
    rgba[..., :3] = np.clip(np.rint(np.stack(rgb, axis=2)), 0, 255)
    return rgba


def _bayer(message: Any, pattern: str, size: int, step: int) -> NDArray[np.uint8]:
    raw = pixels_of(message, f"u{size}", 1)[..., 0]
    height, width = raw.shape[0] // 2 * 2, raw.shape[1] // 2 * 2
    if not height or not width:
        raise UnusableMessageError(f"{message.encoding} needs blocks of 2 x 2 pixels")
    corners = [
        raw[row:height:2, column:width:2] for row, column in ((0, 0), (0, 1), (1, 0), (1, 1))
    ]
    coarse = [corner[::step, ::step].astype(np.uint32) >> (8 * size - 8) for corner in corners]
    greens = [corner for corner, name in zip(coarse, pattern, strict=True) if name == "g"]
    rgba = np.full((*coarse[0].shape, 4), 255, dtype=np.uint8)
    rgba[..., 0] = coarse[pattern.index("r")]
    rgba[..., 1] = (greens[0] + greens[1]) // 2
    rgba[..., 2] = coarse[pattern.index("b")]
    return rgba


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
    :func:`rgba_of`.
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
