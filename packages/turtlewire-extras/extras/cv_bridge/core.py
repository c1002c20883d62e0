"""The bridge between image messages and arrays."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import numpy as np

from cv_bridge.encodings import (
    DEPTHS,
    Encoding,
    convert,
    cv_type,
    parse_encoding,
    parse_type_name,
    rows_of_data,
)
from sensor_msgs.msg import CompressedImage, Image

if TYPE_CHECKING:
    from std_msgs.msg import Header

__all__ = ["CvBridge", "CvBridgeError"]

#: The file endings that OpenCV writes and that ROS 2 accepts.
_FORMATS = (
    *("bmp", "jp2", "jpe", "jpeg", "jpg", "pbm", "pgm"),
    *("png", "ppm", "ras", "sr", "tif", "tiff"),
)


class CvBridgeError(TypeError):
    """An image cannot be converted."""


class CvBridge:
    """Converts image messages to NumPy arrays, as OpenCV has them, and back.

    ::

        bridge = CvBridge()
        array = bridge.imgmsg_to_cv2(message, desired_encoding="bgr8")
        message = bridge.cv2_to_imgmsg(array, encoding="bgr8")

    Attributes:
        cvtype_to_name: Names of OpenCV's types by number: ``{16: "CV_8UC3"}``.
        numpy_type_to_cvtype: OpenCV's names of the types of numbers: ``{"uint8": "8U"}``.
        numpy_type_to_cvtype_num: Their numbers.
    """

    def __init__(self) -> None:
        names = ("8U", "8S", "16U", "16S", "32S", "32F", "64F", "16F")
        self.numpy_type_to_cvtype = dict(zip(DEPTHS, names, strict=True))
        self.cvdepth_to_numpy_depth = dict(enumerate(DEPTHS))
        self.cvtype_to_name = {
            cv_type(depth, channels): f"CV_{name}C{channels}"
            for depth, name in self.numpy_type_to_cvtype.items()
            for channels in (1, 2, 3, 4)
        }

    # -- types

    def dtype_with_channels_to_cvtype2(self, dtype: Any, n_channels: int) -> str:
        """Return the name of a type: ``8UC3``."""
        return f"{self.numpy_type_to_cvtype[np.dtype(dtype).name]}C{n_channels}"

    def cvtype2_to_dtype_with_channels(self, cvtype: int | str) -> tuple[str, int]:
        """Return NumPy's name and the channels of a type of OpenCV, by number or name."""
        if isinstance(cvtype, str):
            found = parse_type_name(cvtype)
            if found is None:
                raise CvBridgeError(f"'{cvtype}' is not the name of a type, such as 8UC3")
            return found
        return DEPTHS[cvtype & 7], (cvtype >> 3) + 1

    def encoding_to_cvtype2(self, encoding: str) -> int:
        """Return the number of an encoding's type: 16 for ``bgr8``.

        Raises:
            CvBridgeError: The encoding does not exist.
        """
        found = _encoding(encoding)
        return cv_type(found.depth, found.channels)

    def encoding_to_dtype_with_channels(self, encoding: str) -> tuple[str, int]:
        """Return NumPy's name and the channels of an encoding.

        Raises:
            CvBridgeError: The encoding does not exist.
        """
        found = _encoding(encoding)
        return found.depth, found.channels

    # -- images

    def imgmsg_to_cv2(self, img_msg: Image, desired_encoding: str = "passthrough") -> Any:
        """Convert a message to an array.

        Args:
            img_msg: The message.
            desired_encoding: The encoding of the array; ``passthrough`` for that of the message.

        Returns:
            An array of shape (rows, columns) or (rows, columns, channels).

        Raises:
            CvBridgeError: An encoding does not exist, the message is too short, or the encodings
                do not fit.
        """
        source = _encoding(img_msg.encoding)
        image = _pixels(img_msg, source)
        if desired_encoding == "passthrough":
            return image
        return _converted(image, source, _encoding(desired_encoding))

    def cv2_to_imgmsg(
        self, cvim: Any, encoding: str = "passthrough", header: Header | None = None
    ) -> Image:
        """Convert an array to a message.

        Args:
            cvim: An array of shape (rows, columns) or (rows, columns, channels).
            encoding: Its encoding; ``passthrough`` for its type, such as ``8UC3``.
            header: The header of the message.

        Raises:
            CvBridgeError: The array is not an image, or does not have the encoding.
        """
        image = _array(cvim)
        channels = image.shape[2] if image.ndim == 3 else 1
        name = self.dtype_with_channels_to_cvtype2(image.dtype, channels)
        if encoding == "passthrough":
            encoding = name
        else:
            wanted = _encoding(encoding)
            if (wanted.depth, wanted.channels) != (image.dtype.name, channels):
                raise CvBridgeError(
                    f"encoding specified as {encoding}, but image has incompatible type {name}"
                )
        message = Image(encoding=encoding, height=image.shape[0], width=image.shape[1])
        if header is not None:
            message.header = header
        message.is_bigendian = int(_is_big_endian(image.dtype))
        data = image.tobytes()
        message.step = len(data) // image.shape[0] if image.shape[0] else 0
        message.data = data
        return message

    # -- compressed images, with OpenCV

    def compressed_imgmsg_to_cv2(
        self, cmprs_img_msg: CompressedImage, desired_encoding: str = "passthrough"
    ) -> Any:
        """Decode a compressed image.

        Args:
            cmprs_img_msg: The message.
            desired_encoding: The encoding of the array; ``passthrough`` for what the file has.

        Raises:
            CvBridgeError: The image cannot be decoded, or OpenCV is not installed.
        """
        cv2 = _opencv()
        data = np.frombuffer(bytes(cmprs_img_msg.data), np.uint8)
        image = cv2.imdecode(data, cv2.IMREAD_UNCHANGED) if len(data) else None
        if image is None:
            raise CvBridgeError(f"cannot decode a compressed image, '{cmprs_img_msg.format}'")
        if desired_encoding == "passthrough":
            return image
        space = {1: "mono", 3: "bgr", 4: "bgra"}[image.shape[2] if image.ndim == 3 else 1]
        channels = 1 if space == "mono" else len(space)
        source = Encoding(image.dtype.name, channels, space)
        return _converted(image, source, _encoding(desired_encoding))

    def cv2_to_compressed_imgmsg(self, cvim: Any, dst_format: str = "jpg") -> CompressedImage:
        """Compress an array.

        Args:
            cvim: The image: gray, or blue, green and red.
            dst_format: ``jpg``, ``png`` …

        Raises:
            CvBridgeError: The image cannot be encoded, or OpenCV is not installed.
        """
        cv2 = _opencv()
        if dst_format not in _FORMATS:
            raise CvBridgeError(f"unknown format '{dst_format}'; use {', '.join(_FORMATS)}")
        done, data = cv2.imencode(f".{dst_format}", _array(cvim))
        if not done:
            raise CvBridgeError(f"cannot encode the image as '{dst_format}'")
        return CompressedImage(format=dst_format, data=data.tobytes())


def _encoding(name: str) -> Encoding:
    found = parse_encoding(name)
    if found is None:
        raise CvBridgeError(f"Unrecognized image encoding [{name}]")
    return found


def _array(image: Any) -> Any:
    if not isinstance(image, (np.ndarray, np.generic)):
        raise CvBridgeError("Your input type is not a numpy array")
    if image.ndim not in (2, 3) or image.dtype.name not in DEPTHS:
        raise CvBridgeError(
            f"expected an image, got an array of {image.ndim} dimensions and type {image.dtype}"
        )
    return image


def _pixels(message: Image, encoding: Encoding) -> Any:
    """Return the message's pixels as an array of the machine's byte order."""
    dtype = np.dtype(encoding.depth).newbyteorder(">" if message.is_bigendian else "<")
    rows = rows_of_data(encoding, message.height)
    columns, channels = message.width, encoding.channels
    row = columns * channels * dtype.itemsize
    data = np.frombuffer(message.data, np.uint8)
    # The last row may lack what pads the others.
    if message.step < row or len(data) < max(0, rows - 1) * message.step + (row if rows else 0):
        raise CvBridgeError(
            f"{rows} rows of {columns} pixels in {message.encoding} need {rows * row} bytes, and "
            f"the message has {len(data)}, with {message.step} in each row"
        )
    view = np.lib.stride_tricks.as_strided(data, (rows, row), (message.step, 1))
    pixels = np.ascontiguousarray(view).view(dtype)
    if channels > 1:
        pixels = pixels.reshape(rows, columns, channels)
    return pixels.astype(encoding.depth, copy=False)


def _converted(image: Any, source: Encoding, target: Encoding) -> Any:
    same_space = source.space == target.space or not source.space or not target.space
    if same_space and source.channels != target.channels:
        raise CvBridgeError(
            f"cannot convert {source.channels} channels to {target.channels} without color spaces"
        )
    try:
        return convert(image, source, target)
    except ValueError as error:
        raise CvBridgeError(str(error)) from error


def _opencv() -> Any:
    try:
        import cv2
    except ImportError:
        raise CvBridgeError(
            "compressed images need OpenCV: pip install opencv-python-headless"
        ) from None
    return cv2


def _is_big_endian(dtype: Any) -> bool:
    return bool(dtype.byteorder == ">" or (dtype.byteorder == "=" and sys.byteorder == "big"))
