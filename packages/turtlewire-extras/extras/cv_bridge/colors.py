"""Converts images between color spaces; gray is rounded as in OpenCV."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from cv_bridge.encodings import Encoding

__all__ = ["convert"]

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
    if (source in _BAYER or source in _YUV) and target in _SPACES:
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
_BAYER = {
    "bayer_rggb": "BayerBG",
    "bayer_bggr": "BayerRG",
    "bayer_gbrg": "BayerGR",
    "bayer_grbg": "BayerGB",
}
_YUV = {
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
        f"COLOR_YUV2{wanted}_{_YUV[source]}"
        if source in _YUV
        else f"COLOR_{_BAYER[source]}2{wanted}"
    )
    if not hasattr(cv2, name):
        raise ValueError(f"OpenCV does not convert '{source}' to '{target}'")
    return cv2.cvtColor(image, getattr(cv2, name))
