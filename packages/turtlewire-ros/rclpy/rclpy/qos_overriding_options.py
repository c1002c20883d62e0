"""Lets parameters change the QoS of an endpoint at its creation.

They are called ``qos_overrides.<topic>.<publisher or subscription>.<policy>``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from .duration import Duration
from .exceptions import ParameterAlreadyDeclaredException
from .qos import QoSPolicyEnum, QoSPolicyKind

if TYPE_CHECKING:
    from rcl_interfaces.msg import SetParametersResult

    from ._node.parameters import NodeParameters
    from .qos import QoSProfile


class InvalidQosOverridesError(Exception):
    """The callback of :class:`QoSOverridingOptions` rejected the profile."""


class QoSOverridingOptions:
    """The policies of an endpoint that parameters can set.

    Args:
        policy_kinds: Those policies.
        callback: Gets the resulting profile and decides whether it may be used.
        entity_id: Distinguishes several endpoints of one topic in one node.
    """

    def __init__(
        self,
        policy_kinds: Iterable[QoSPolicyKind],
        *,
        callback: Callable[[QoSProfile], SetParametersResult] | None = None,
        entity_id: str | None = None,
    ) -> None:
        self._policy_kinds = list(policy_kinds)
        self._callback = callback
        self._entity_id = entity_id

    @classmethod
    def with_default_policies(
        cls,
        *,
        callback: Callable[[QoSProfile], SetParametersResult] | None = None,
        entity_id: str | None = None,
    ) -> QoSOverridingOptions:
        """History, depth and reliability."""
        policies = (QoSPolicyKind.HISTORY, QoSPolicyKind.DEPTH, QoSPolicyKind.RELIABILITY)
        return cls(policies, callback=callback, entity_id=entity_id)

    @property
    def policy_kinds(self) -> list[QoSPolicyKind]:
        """The policies that can be set."""
        return self._policy_kinds

    @property
    def callback(self) -> Callable[[QoSProfile], SetParametersResult] | None:
        """Callback that validates the resulting profile."""
        return self._callback

    @property
    def entity_id(self) -> str | None:
        """Identifier that distinguishes the endpoint."""
        return self._entity_id


def __getattr__(name: str) -> Any:
    """Return the message class ``QosCallbackResult``, which is made when it is first used."""
    if name != "QosCallbackResult":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from rcl_interfaces.msg import SetParametersResult

    return SetParametersResult


def declare_qos_parameters(
    entity_type: str,
    node: NodeParameters,
    topic_name: str,
    qos: QoSProfile,
    options: QoSOverridingOptions,
) -> None:
    """Declare the parameters of an endpoint and put their values into ``qos``.

    Args:
        entity_type: ``publisher`` or ``subscription``.
        node: What keeps the parameters: a node, or a part of it.
        topic_name: Fully qualified and remapped name.
        qos: Gives the defaults, and takes the values.
        options: Which policies.

    Raises:
        InvalidQosOverridesError: The callback rejected the profile.
        ValueError: A parameter has a value that its policy does not have.
    """
    prefix = f"qos_overrides.{topic_name}.{entity_type}" + (
        f"_{options.entity_id}" if options.entity_id is not None else ""
    )
    what = f"for {entity_type} `{topic_name}` with id `{options.entity_id}`"
    for policy in options.policy_kinds:
        if policy is QoSPolicyKind.LIFESPAN and entity_type == "subscription":
            continue  # samples live as long as the publisher says
        field = policy.name.lower()
        setattr(
            qos,
            field,
            _from_parameter(
                getattr(qos, field),
                _declare(node, f"{prefix}.{field}", getattr(qos, field), what),
                field,
            ),
        )
    result = None if options.callback is None else options.callback(qos)
    if result is not None and not result.successful:
        raise InvalidQosOverridesError(
            f"Provided QoS overrides {what}, are not valid: {result.reason}"
        )


def _declare(node: NodeParameters, name: str, default: Any, what: str) -> Any:
    """Return the value of the read-only parameter of one policy."""
    from rcl_interfaces.msg import ParameterDescriptor

    field = name.rpartition(".")[2]
    descriptor = ParameterDescriptor(description=f"{field} {what}", read_only=True)
    try:
        return node.declare_parameter(name, _to_parameter(default), descriptor).value
    except ParameterAlreadyDeclaredException:
        # As in ROS 2, a second endpoint of the topic uses the parameters of the first.
        return node.get_parameter(name).value


def _to_parameter(value: Any) -> Any:
    if isinstance(value, QoSPolicyEnum):
        return value.short_key
    return value.nanoseconds if isinstance(value, Duration) else value


def _from_parameter(present: Any, value: Any, field: str) -> Any:
    if isinstance(present, Duration):
        return Duration(nanoseconds=value)
    if not isinstance(present, QoSPolicyEnum):
        return value
    try:
        return type(present)(type(present).get_from_short_key(value))
    except KeyError:
        known = ", ".join(type(present).short_keys())
        raise ValueError(
            f"Unexpected QoS override for policy `{field}`: `{value}`; choose from {known}"
        ) from None
