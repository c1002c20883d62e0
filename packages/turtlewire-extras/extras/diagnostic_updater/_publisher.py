"""Topics whose frequency and stamps are watched."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from diagnostic_updater._update_functions import FrequencyStatus, TimeStampStatus
from diagnostic_updater._updater import CompositeDiagnosticTask

if TYPE_CHECKING:
    from diagnostic_updater._update_functions import FrequencyStatusParam, TimeStampStatusParam
    from diagnostic_updater._updater import DiagnosticTaskVector
    from rclpy.publisher import Publisher

__all__ = ["DiagnosedPublisher", "HeaderlessTopicDiagnostic", "TopicDiagnostic"]


class HeaderlessTopicDiagnostic(CompositeDiagnosticTask):
    """Watches the frequency of a topic whose messages have no header.

    Args:
        name: Name of the topic.
        diag: The `Updater`, to which it is added.
        freq: The expected frequency.
    """

    def __init__(self, name: str, diag: DiagnosticTaskVector, freq: FrequencyStatusParam) -> None:
        super().__init__(f"{name} topic status")
        self.diag = diag
        self.freq = FrequencyStatus(freq)
        self.addTask(self.freq)
        diag.add(self)

    def tick(self) -> None:
        """Count a message."""
        self.freq.tick()

    def clear_window(self) -> None:
        """Forget all messages."""
        self.freq.clear()


class TopicDiagnostic(HeaderlessTopicDiagnostic):
    """Watches the frequency and the stamps of a topic.

    Args:
        name: Name of the topic.
        diag: The `Updater`, to which it is added.
        freq: The expected frequency.
        stamp: How old the stamps may be.
    """

    def __init__(
        self,
        name: str,
        diag: DiagnosticTaskVector,
        freq: FrequencyStatusParam,
        stamp: TimeStampStatusParam,
    ) -> None:
        super().__init__(name, diag, freq)
        self.stamp = TimeStampStatus(stamp)
        self.addTask(self.stamp)

    def tick(self, stamp: Any) -> None:  # type: ignore[override]  # ROS 2's signature
        """Count a message, and look at its stamp."""
        super().tick()
        self.stamp.tick(stamp)


class DiagnosedPublisher(TopicDiagnostic):
    """Publishes messages and watches them.

    Args:
        pub: The publisher.
        diag: The `Updater`, to which it is added.
        freq: The expected frequency.
        stamp: How old the stamps may be.
    """

    def __init__(
        self,
        pub: Publisher[Any],
        diag: DiagnosticTaskVector,
        freq: FrequencyStatusParam,
        stamp: TimeStampStatusParam,
    ) -> None:
        super().__init__(pub.topic_name, diag, freq, stamp)
        self.publisher = pub

    def publish(self, message: Any) -> None:
        """Look at the message's stamp, and publish it."""
        self.tick(message.header.stamp)
        self.publisher.publish(message)
