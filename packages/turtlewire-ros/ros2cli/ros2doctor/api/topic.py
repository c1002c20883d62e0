"""The topics of the domain."""

from __future__ import annotations

from ros2doctor.api.format import doctor_warn
from ros2doctor.api.graph_snapshot import SKIP_TOPICS, list_report, snapshot
from ros2doctor.api.reporting import DoctorCheck, DoctorReport, Report, Result

__all__ = ["SKIP_TOPICS", "TopicCheck", "TopicReport"]


class TopicCheck(DoctorCheck):
    """Warns of topics that have publishers only, or subscriptions only."""

    def category(self) -> str:
        return "topic"

    def check(self) -> Result:
        result = Result()
        for topic in snapshot().topics:
            if topic.providers and not topic.users:
                doctor_warn(f"Publisher without subscriber detected on {topic.name}.")
                result.add_warning()
            elif topic.users and not topic.providers:
                doctor_warn(f"Subscriber without publisher detected on {topic.name}.")
                result.add_warning()
        return result


class TopicReport(DoctorReport):
    """Reports how many publishers and subscriptions each topic has."""

    def category(self) -> str:
        return "topic"

    def report(self) -> Report:
        labels = ("topic", "publisher count", "subscriber count")
        return list_report("TOPIC LIST", labels, snapshot().topics)
