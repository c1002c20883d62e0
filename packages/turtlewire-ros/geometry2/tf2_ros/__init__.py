"""tf2_ros as in ROS 2: buffers that are filled from the wire, and broadcasters.

================================  ===========================================================
module                            contents
================================  ===========================================================
`buffer`                          `Buffer`: a node's buffer
`buffer_interface`                `BufferInterface`: what all buffers share; registered types
`buffer_client`, `buffer_server`  lookups in a buffer of another process; the executable
                                  ``buffer_server``
`transform_listener`              `TransformListener`: fills a buffer from the wire
`static_transform_listener`       `StaticTransformListener`: of static transforms only
`transform_broadcaster`           `TransformBroadcaster`
`static_transform_broadcaster`    `StaticTransformBroadcaster`: also for later subscriptions
`message_filter`                  holds messages back until they can be transformed
`transform_futures`               futures of transforms, and their timeouts
`notebook`                        a ``TransformStamped`` in Jupyter
`tf2_echo`, `tf2_monitor`         the tools of these names
`static_transform_publisher`      the executable of this name
`command_line`                    command lines of the tools
================================  ===========================================================
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from tf2_py import (
    BufferCore,
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)

from .buffer import Buffer
from .buffer_interface import (
    BufferInterface,
    ConvertRegistration,
    NotImplementedException,
    Stamped,
    TransformRegistration,
    TypeException,
    convert,
)
from .static_transform_broadcaster import StaticTransformBroadcaster
from .static_transform_listener import StaticTransformListener
from .transform_broadcaster import TransformBroadcaster
from .transform_listener import DEFAULT_STATIC_TF_TOPIC, DEFAULT_TF_TOPIC, TransformListener

if TYPE_CHECKING:
    from .buffer_client import BufferClient
    from .buffer_server import BufferServer
    from .message_filter import FilterFailureReason, MessageFilter

if "IPython" in sys.modules:
    from . import notebook as notebook

__all__ = [
    "DEFAULT_STATIC_TF_TOPIC",
    "DEFAULT_TF_TOPIC",
    "Buffer",
    "BufferClient",
    "BufferCore",
    "BufferInterface",
    "BufferServer",
    "ConnectivityException",
    "ConvertRegistration",
    "ExtrapolationException",
    "FilterFailureReason",
    "InvalidArgumentException",
    "LookupException",
    "MessageFilter",
    "NotImplementedException",
    "Stamped",
    "StaticTransformBroadcaster",
    "StaticTransformListener",
    "TimeoutException",
    "TransformBroadcaster",
    "TransformException",
    "TransformListener",
    "TransformRegistration",
    "TypeException",
    "convert",
]

_LAZY = {
    "BufferClient": "tf2_ros.buffer_client",
    "BufferServer": "tf2_ros.buffer_server",
    "FilterFailureReason": "tf2_ros.message_filter",
    "MessageFilter": "tf2_ros.message_filter",
    # ROS 2's package has these because it imports them; programs take them from here.
    "TFMessage": "tf2_msgs.msg",
    "TransformStamped": "geometry_msgs.msg",
}


def __getattr__(name: str) -> Any:
    """Load what few nodes need when it is used first."""
    if name not in _LAZY:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    value = globals()[name] = getattr(import_module(_LAZY[name]), name)
    return value
