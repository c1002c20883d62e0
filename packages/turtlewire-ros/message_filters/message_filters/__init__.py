"""message_filters as in ROS 2: combines messages of several topics by their stamps.

====================  =================================================
module                what it holds
====================  =================================================
`simple_filter`       `SimpleFilter`: callbacks of a filter
`one_message_filter`  the type of callbacks that take one message
`subscriber`          `Subscriber`: the messages of a topic
`cache`               `Cache`: the newest messages, found by time
`time_synchronizer`   `TimeSynchronizer`, `ApproximateTimeSynchronizer`
`stamps`              the stamps of messages
====================  =================================================
"""

from __future__ import annotations

from .cache import Cache
from .simple_filter import SimpleFilter
from .subscriber import Subscriber
from .time_synchronizer import ApproximateTimeSynchronizer, TimeSynchronizer

__all__ = ["ApproximateTimeSynchronizer", "Cache", "SimpleFilter", "Subscriber", "TimeSynchronizer"]
