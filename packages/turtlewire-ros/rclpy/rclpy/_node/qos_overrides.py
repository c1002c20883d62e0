"""The quality of service that parameters of a node may override."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from rclpy._node.parameters import NodeParameters
    from rclpy.qos import QoSProfile
    from rclpy.qos_overriding_options import QoSOverridingOptions


class QosOverrides(NamedTuple):
    """The QoS policies of an endpoint that parameters may override."""

    options: QoSOverridingOptions | None
    parameters: NodeParameters

    def apply(self, kind: str, profile: QoSProfile, resolve_topic: Callable[[], str]) -> QoSProfile:
        """Return the profile with the parameters' values; ``kind`` is publisher or subscription."""
        if self.options is None:
            return profile
        from rclpy.qos_overriding_options import overridden_profile

        return overridden_profile(kind, resolve_topic(), profile, self.options, self.parameters)
