"""The encodings of ``sensor_msgs/msg/Image``: types, channels and color spaces; conversions.

A type of OpenCV, such as ``CV_8UC3``, is a number: depth, plus eight times the channels but one.
"""

from __future__ import annotations

import re
from typing import Any, NamedTuple

import numpy as np

__all__ = [
    "DEPTHS",
    "Encoding",
    "convert",
    "cv_type",
    "parse_encoding",
    "parse_type_name",
    "rows_of_data",
]

#: NumPy's names of OpenCV's depths, in the order of their numbers.
DEPTHS = ("uint8", "int8", "uint16", "int16", "int32", "float32", "float64", "float16")
_DEPTH_NAMES = {"8U": 0, "8S": 1, "16U": 2, "16S": 3, "32S": 4, "32F": 5, "64F": 6, "16F": 7}
_TYPE_NAME = re.compile(r"(?:CV_)?(8U|8S|16U|16S|32S|32F|64F|16F)C?(\d*)")
_COLOR = re.compile(r"(mono|bgra|rgba|bgr|rgb)(8|16)")
_BAYER = re.compile(r"bayer_(rggb|bggr|gbrg|grbg)(8|16)")
#: YUV 4:2:2 has two bytes for each pixel; in the others, rows of color follow those of the image.
_YUV = {"uyvy": 2, "yuyv": 2, "yuv422": 2, "yuv422_yuy2": 2, "nv21": 1, "nv24": 1}
_ROWS = {"nv21": 3 / 2, "nv24": 3}


class Encoding(NamedTuple):
    """The layout of the pixels in an encoding.

    Attributes:
        depth: NumPy's name of the numbers.
        channels: How many numbers a pixel has.
        space: ``mono``, ``rgb``, ``bgr``, ``rgba``, ``bgra``, the name of a Bayer pattern or of a
            YUV encoding; empty for matrices such as ``32FC1``.
    """

    depth: str
    channels: int
    space: str


def rows_of_data(encoding: Encoding, height: int) -> int:
    """Return the number of rows in the data of an image."""
    return int(height * _ROWS.get(encoding.space, 1))


def parse_encoding(name: str) -> Encoding | None:
    """Return what an encoding means; None if there is no such encoding."""
    if match := _COLOR.fullmatch(name):
        channels = 1 if match[1] == "mono" else len(match[1])
        return Encoding(f"uint{match[2]}", channels, match[1])
    if match := _BAYER.fullmatch(name):
        return Encoding(f"uint{match[2]}", 1, f"bayer_{match[1]}")
    if name in _YUV:
        return Encoding("uint8", _YUV[name], name)
    found = parse_type_name(name)
    return None if found is None else Encoding(*found, "")


def parse_type_name(name: str) -> tuple[str, int] | None:
    """Return NumPy's name and the channels of ``8UC3`` or ``CV_8UC3``; None for other names."""
    match = _TYPE_NAME.fullmatch(name)
    return None if match is None else (DEPTHS[_DEPTH_NAMES[match[1]]], int(match[2] or 1))


def cv_type(depth: str, channels: int) -> int:
    """Return the number of a type in OpenCV."""
    return DEPTHS.index(depth) + ((channels - 1) << 3)


_SPACES = ("mono", "rgb", "bgr", "rgba", "bgra")
#: How much red, green and blue contribute to gray, in units of 1/32768, as in OpenCV 4.
_RED, _GREEN, _BLUE, _SHIFT = 9798, 19235, 3735, 15


def convert(image: Any, source: Encoding, target: Encoding) -> Any:
    """Convert an image.

    Args:
        image: An array of shape (rows, columns) or (rows, columns, channels).
        source: Its encoding.
        target: The wanted encoding.

    Returns:
        A new array; the same one if nothing changes.

    Raises:
        ValueError: OpenCV is needed and not installed, or the color spaces do not fit.
    """
    if source.space != target.space:
        image = _in_space(image, source.space, target.space)
    if source.depth == target.depth:
        return image
    return _in_depth(image, source.depth, target.depth)


def _in_space(image: Any, source: str, target: str) -> Any:
    if not source or not target:
        # Encodings without colors, such as 32FC3, fit any color space.
        return image
    if (source in _BAYER_NAMES or source in _YUV_NAMES) and target in _SPACES:
        return _by_opencv(image, source, target)
    if source not in _SPACES or target not in _SPACES:
        raise ValueError(f"cannot convert the color space '{source}' to '{target}'")
    if target == "mono":
        red, green, blue = (image[..., source.index(name)].astype(np.uint32) for name in "rgb")
        gray = red * _RED + green * _GREEN + blue * _BLUE
        return ((gray + (1 << (_SHIFT - 1))) >> _SHIFT).astype(image.dtype)
    found = np.empty((*image.shape[:2], len(target)), image.dtype)
    for place, name in enumerate(target):
        if source == "mono":
            found[..., place] = image if name != "a" else np.iinfo(image.dtype).max
        elif name in source:
            found[..., place] = image[..., source.index(name)]
        else:
            found[..., place] = np.iinfo(image.dtype).max
    return found


def _in_depth(image: Any, source: str, target: str) -> Any:
    """Change the type of the numbers; 8 and 16 bits mean the same brightness."""
    sizes = (np.dtype(source).itemsize, np.dtype(target).itemsize)
    image = image * {(1, 2): 257.0, (2, 1): 255.0 / 65535.0}.get(sizes, 1.0)
    if np.dtype(target).kind in "iu":
        limits = np.iinfo(target)
        image = np.clip(np.rint(image), limits.min, limits.max)
    return image.astype(target)


#: OpenCV names a Bayer pattern after the second row and column: each is its neighbor diagonally.
_BAYER_NAMES = {
    "bayer_rggb": "BayerBG",
    "bayer_bggr": "BayerRG",
    "bayer_gbrg": "BayerGR",
    "bayer_grbg": "BayerGB",
}
_YUV_NAMES = {
    "uyvy": "UYVY",
    "yuv422": "UYVY",
    "yuyv": "YUY2",
    "yuv422_yuy2": "YUY2",
    "nv21": "NV21",
}


def _by_opencv(image: Any, source: str, target: str) -> Any:
    try:
        import cv2
    except ImportError:
        raise ValueError(
            f"the encoding '{source}' needs OpenCV: pip install opencv-python-headless"
        ) from None
    wanted = {"mono": "GRAY"}.get(target, target.upper())
    name = (
        f"COLOR_YUV2{wanted}_{_YUV_NAMES[source]}"
        if source in _YUV_NAMES
        else f"COLOR_{_BAYER_NAMES[source]}2{wanted}"
    )
    if not hasattr(cv2, name):
        raise ValueError(f"OpenCV does not convert '{source}' to '{target}'")
    return cv2.cvtColor(image, getattr(cv2, name))
