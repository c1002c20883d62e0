"""message_filters as in ROS 2: combines messages of several topics by their stamps."""

from __future__ import annotations

from .cache import Cache
from .simple_filter import SimpleFilter
from .subscriber import Subscriber
from .time_synchronizer import ApproximateTimeSynchronizer, TimeSynchronizer

__all__ = ["ApproximateTimeSynchronizer", "Cache", "SimpleFilter", "Subscriber", "TimeSynchronizer"]
