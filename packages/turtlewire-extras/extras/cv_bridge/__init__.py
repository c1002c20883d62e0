"""Converts between image messages and the arrays of OpenCV, in plain NumPy.

OpenCV itself is needed for compressed images, and for Bayer and YUV encodings.

===========  ======================================================
module       contents
===========  ======================================================
`core`       `CvBridge`
`encodings`  pixel types by encoding, and OpenCV's type numbers
`colors`     converts between color spaces
===========  ======================================================
"""

from cv_bridge.core import CvBridge, CvBridgeError

__all__ = ["CvBridge", "CvBridgeError"]
