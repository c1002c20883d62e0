"""Publishes the state of a node on ``/diagnostics``.

====================  ===========================================================
module                contents
====================  ===========================================================
`_status_wrapper`     `DiagnosticStatusWrapper`, which a task fills
`_tasks`              tasks of functions, of several tasks, and lists of tasks
`_update_functions`   tasks that watch frequencies and stamps
`_updater`            `Updater`, which runs the tasks and publishes
`_publisher`          publishers whose frequency and stamps are watched
====================  ===========================================================
"""

from diagnostic_updater._publisher import (
    DiagnosedPublisher,
    HeaderlessTopicDiagnostic,
    TopicDiagnostic,
)
from diagnostic_updater._status_wrapper import DiagnosticStatusWrapper
from diagnostic_updater._tasks import (
    CompositeDiagnosticTask,
    DiagnosticTask,
    DiagnosticTaskVector,
    FunctionDiagnosticTask,
)
from diagnostic_updater._update_functions import (
    FrequencyStatus,
    FrequencyStatusParam,
    Heartbeat,
    TimeStampStatus,
    TimeStampStatusParam,
)
from diagnostic_updater._updater import Updater

__all__ = [
    "CompositeDiagnosticTask",
    "DiagnosedPublisher",
    "DiagnosticStatusWrapper",
    "DiagnosticTask",
    "DiagnosticTaskVector",
    "FrequencyStatus",
    "FrequencyStatusParam",
    "FunctionDiagnosticTask",
    "HeaderlessTopicDiagnostic",
    "Heartbeat",
    "TimeStampStatus",
    "TimeStampStatusParam",
    "TopicDiagnostic",
    "Updater",
]
