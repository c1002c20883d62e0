"""message_filters as in ROS 2: combines messages of several topics by their stamps.

====================  =================================================
module                contents
====================  =================================================
`simple_filter`       `SimpleFilter`: callbacks of a filter, also typed
`subscriber`          `Subscriber`: the messages of a topic
`cache`               `Cache`: the newest messages, found by time
`chain`               `Chain`: a sequence of filters
`delta_filter`        messages in which fields have changed: `DeltaFilter` and others
`input_aligner`       `InputAligner`: several inputs in the order of their stamps
`time_sequencer`      `TimeSequencer`: messages in the order of their stamps
`time_synchronizer`   `TimeSynchronizer`, `ApproximateTimeSynchronizer`
`stamps`              the stamps of messages
====================  =================================================
"""

from .cache import Cache
from .chain import Chain
from .simple_filter import SimpleFilter
from .subscriber import Subscriber
from .time_sequencer import TimeSequencer
from .time_synchronizer import ApproximateTimeSynchronizer, TimeSynchronizer

__all__ = [
    "ApproximateTimeSynchronizer",
    "Cache",
    "Chain",
    "SimpleFilter",
    "Subscriber",
    "TimeSequencer",
    "TimeSynchronizer",
]
