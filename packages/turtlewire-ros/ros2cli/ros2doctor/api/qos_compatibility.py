"""Publishers and subscriptions with incompatible quality of service."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from ros2doctor.api.format import doctor_error, doctor_warn
from ros2doctor.api.graph_snapshot import snapshot
from ros2doctor.api.reporting import DoctorCheck, DoctorReport, Report, Result

if TYPE_CHECKING:
    from rclpy.qos import QoSCompatibility


class _Pair(NamedTuple):
    topic: str
    type_name: str
    publisher: str
    subscription: str
    compatibility: QoSCompatibility
    reason: str


class QoSCompatibilityCheck(DoctorCheck):
    """Looks for publishers and subscriptions of a topic that do not match."""

    def category(self) -> str:
        return "middleware"

    def check(self) -> Result:
        from rclpy.qos import QoSCompatibility

        result = Result()
        for pair in _pairs():
            if pair.compatibility == QoSCompatibility.WARNING:
                result.add_warning()
                doctor_warn(
                    f"QoS compatibility warning found on topic [{pair.topic}]: {pair.reason}"
                )
            elif pair.compatibility == QoSCompatibility.ERROR:
                result.add_error()
                doctor_error(
                    f"QoS compatibility error found on topic [{pair.topic}]: {pair.reason}"
                )
        return result


class QoSCompatibilityReport(DoctorReport):
    """Reports whether each publisher and each subscription of a topic match."""

    def category(self) -> str:
        return "middleware"

    def report(self) -> Report:
        report = Report("QOS COMPATIBILITY LIST")
        for pair in _pairs():
            report.add_to_report("topic [type]", f"{pair.topic} [{pair.type_name}]")
            report.add_to_report("publisher node", pair.publisher)
            report.add_to_report("subscriber node", pair.subscription)
            report.add_to_report("compatibility status", pair.reason or "OK")
        if not report.items:
            report.add_to_report("compatibility status", "No publisher/subscriber pairs found")
        return report


def _pairs() -> Iterator[_Pair]:
    from rclpy.qos import QoSProfile, qos_check_compatible
    from turtlewire.doctor.graph_findings import owner_of

    for topic, endpoints in snapshot().endpoints.items():
        for publisher in (end for end in endpoints if end.kind == "publisher"):
            for subscription in (end for end in endpoints if end.kind == "subscription"):
                level, reason = qos_check_compatible(
                    QoSProfile.from_wire(publisher.qos), QoSProfile.from_wire(subscription.qos)
                )
                yield _Pair(
                    topic,
                    publisher.type_name,
                    owner_of(publisher),
                    owner_of(subscription),
                    level,
                    reason.rstrip(";"),
                )
