"""tf2_py as in ROS 2: the BufferCore, and the exceptions of tf2.

=============  ==============================================================
module         contents
=============  ==============================================================
`buffer_core`  `BufferCore`
`messages`     times of messages and of rclpy; results as ``TransformStamped``
=============  ==============================================================
"""

from tf2_py.buffer_core import BufferCore
from turtlewire.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)

__all__ = [
    "BufferCore",
    "ConnectivityException",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "TimeoutException",
    "TransformException",
]
