"""Converts between image messages and the arrays of OpenCV, in plain NumPy.

OpenCV itself is needed for compressed images, and for Bayer and YUV encodings.

===========  =================================================================
module       contents
===========  =================================================================
`core`       `CvBridge`
`encodings`  encodings, OpenCV's type numbers, conversions between color spaces
===========  =================================================================
"""

from cv_bridge.core import CvBridge, CvBridgeError

__all__ = ["CvBridge", "CvBridgeError"]
