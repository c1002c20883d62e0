"""Types of statistics_msgs.msg; generated."""

import builtin_interfaces.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "MetricsMessage",
    "StatisticDataPoint",
    "StatisticDataType",
]

class MetricsMessage(Message):
    measurement_source_name: str
    metrics_source: str
    unit: str
    window_start: builtin_interfaces.msg.Time
    window_stop: builtin_interfaces.msg.Time
    statistics: list[StatisticDataPoint]
    def __init__(
        self,
        *,
        measurement_source_name: str = ...,
        metrics_source: str = ...,
        unit: str = ...,
        window_start: builtin_interfaces.msg.Time = ...,
        window_stop: builtin_interfaces.msg.Time = ...,
        statistics: list[StatisticDataPoint] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class StatisticDataPoint(Message):
    data_type: int
    data: float
    def __init__(
        self,
        *,
        data_type: int = ...,
        data: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class StatisticDataType(Message):
    STATISTICS_DATA_TYPE_UNINITIALIZED: ClassVar[int]
    STATISTICS_DATA_TYPE_AVERAGE: ClassVar[int]
    STATISTICS_DATA_TYPE_MINIMUM: ClassVar[int]
    STATISTICS_DATA_TYPE_MAXIMUM: ClassVar[int]
    STATISTICS_DATA_TYPE_STDDEV: ClassVar[int]
    STATISTICS_DATA_TYPE_SAMPLE_COUNT: ClassVar[int]
    def __init__(self, *, check_fields: bool = ...) -> None: ...
