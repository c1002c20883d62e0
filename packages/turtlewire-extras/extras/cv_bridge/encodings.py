"""The encodings of ``sensor_msgs/msg/Image``: their types, channels and color spaces.

A type of OpenCV, such as ``CV_8UC3``, is a number: depth, plus eight times the channels but one.
"""

from __future__ import annotations

import re
from typing import NamedTuple

__all__ = ["DEPTHS", "Encoding", "cv_type", "parse_encoding", "parse_type_name", "rows_of_data"]

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
