"""The endpoints and timers of a node.

Creates publishers, subscriptions, clients, services, timers and guard conditions, stores
them, and closes them.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from copy import copy
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from rclpy._execution.entity import Entity
from rclpy._execution.handle import EndpointImpl, closed_on_error
from rclpy._execution.membership import Membership
from rclpy._node.checks import (
    NameResolver,
    check_callable,
    check_open,
    in_open_context,
    validate_qos,
)
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.client import Client
from rclpy.event_handler import EventHandler, PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.guard_condition import GuardCondition
from rclpy.publisher import Publisher
from rclpy.service import Service
from rclpy.subscription import Subscription
from rclpy.timer import Rate, Timer
from rclpy.type_support import (
    check_is_valid_msg_type,
    check_is_valid_srv_type,
    service_types,
    type_id,
)
from turtlewire.msg import type_name

if TYPE_CHECKING:
    from rclpy._execution.entity import EntityHost
    from rclpy._node.parameters import NodeParameters
    from rclpy._node.state import NodeState
    from rclpy.callback_groups import CallbackGroup
    from rclpy.clock import Clock
    from rclpy.qos import QoSProfile
    from rclpy.qos_overriding_options import QoSOverridingOptions
    from rclpy.waitable import Waitable
    from turtlewire.wire import base
    from turtlewire.wire.base import ServiceTypes, TypeId

_Owned = TypeVar("_Owned")


def endpoints_of(node: Any) -> OwnEndpoints:
    """Return a node's endpoints (internal)."""
    endpoints: OwnEndpoints = node._rclpy_endpoints
    return endpoints


class QosOverrides(NamedTuple):
    """The QoS policies of an endpoint that parameters may override."""

    options: QoSOverridingOptions | None
    parameters: NodeParameters

    def apply(self, kind: str, profile: QoSProfile, resolve_topic: Callable[[], str]) -> QoSProfile:
        """Return the profile with the parameters' values; ``kind`` is publisher or subscription."""
        if self.options is None:
            return profile
        from rclpy.qos_overriding_options import declare_qos_parameters

        profile = copy(profile)  # presets such as `qos_profile_sensor_data` are shared
        declare_qos_parameters(kind, self.parameters, resolve_topic(), profile, self.options)
        return profile


class OwnEndpoints:
    """The endpoints of one node. Thread-safe.

    Attributes:
        default_callback_group: Of entities that are made without one.
        names: The full names of topics and services.
    """

    def __init__(self, core: NodeState) -> None:
        self._core = core
        self.names = NameResolver(core)
        self._membership: Membership | None = None
        self._lock = threading.Lock()
        self._owned: dict[type, list[Any]] = {}
        self.default_callback_group: CallbackGroup = MutuallyExclusiveCallbackGroup()

    def of(self, kind: type) -> list[Any]:
        """Return the endpoints of one class in the order of their creation."""
        with self._lock:
            return list(self._owned.get(kind, ()))

    def entities(self) -> list[Entity]:
        """Return the entities that an executor serves."""
        with self._lock:
            return [
                owned
                for group in self._owned.values()
                for owned in group
                if isinstance(owned, Entity)
            ]

    def announce(
        self, kind: str, interface: Any, name: str, profile: QoSProfile, **options: Any
    ) -> EndpointImpl:
        """Announce an endpoint; return what the constructor of its class needs.

        Args:
            kind: ``publisher``, ``subscription``, ``service`` or ``client``.
            interface: The class of its messages, or the service class.
            name: Name of the topic or service.
            profile: Its quality of service.
            **options: Of the middleware.
        """
        types: TypeId | ServiceTypes
        if kind in {"publisher", "subscription"}:
            check_is_valid_msg_type(interface)
            name, types = self.names.resolve_topic(name), type_id(type_name(interface))
        else:
            check_is_valid_srv_type(interface)
            name, types = self.names.resolve_service(name), service_types(type_name(interface))
        with in_open_context(self._core.checked().context, kind):
            create = getattr(self._core.wire, f"create_{kind}")
            return EndpointImpl(create(name, types, profile.to_wire(), **options), self._core)

    def create_publisher(
        self,
        msg_type: Any,
        topic: str,
        qos_profile: QoSProfile | int,
        callback_group: CallbackGroup | None = None,
        event_callbacks: PublisherEventCallbacks | None = None,
        publisher_class: type[Publisher] = Publisher,
        overrides: QosOverrides | None = None,
    ) -> Publisher:
        profile = validate_qos(qos_profile)
        if overrides is not None:
            profile = overrides.apply("publisher", profile, lambda: self.names.resolve_topic(topic))
        with closed_on_error(self.announce("publisher", msg_type, topic, profile)) as impl:
            publisher = publisher_class(
                impl,
                msg_type,
                topic,
                profile,
                event_callbacks=event_callbacks or PublisherEventCallbacks(),
                callback_group=callback_group or self.default_callback_group,
            )
        for handler in publisher.event_handlers:
            self._own(EventHandler, handler)
        return self._own(Publisher, publisher)

    def make_publisher(self, msg_type: Any, topic: str, qos_profile: QoSProfile | int) -> Publisher:
        """Return a publisher that the caller owns."""
        profile = validate_qos(qos_profile)
        return Publisher(
            self.announce("publisher", msg_type, topic, profile), msg_type, topic, profile
        )

    def create_subscription(
        self,
        msg_type: Any,
        topic: str,
        callback: Callable[..., Any],
        qos_profile: QoSProfile | int,
        callback_group: CallbackGroup | None,
        event_callbacks: SubscriptionEventCallbacks | None,
        raw: bool,
        overrides: QosOverrides,
        sink: base.Sink | None = None,
    ) -> Subscription:
        """Create a subscription; see :meth:`rclpy.node.Node.create_subscription`.

        A sink may handle messages without Python; the callback gets the messages that it leaves.
        """
        profile = validate_qos(qos_profile)
        profile = overrides.apply("subscription", profile, lambda: self.names.resolve_topic(topic))
        events = event_callbacks or SubscriptionEventCallbacks()
        subscription = self.make_subscription(
            msg_type, topic, callback, profile, callback_group, raw, sink, events
        )
        for handler in subscription.event_handlers:
            self._own(EventHandler, handler)
        return self._own(Subscription, subscription)

    def make_subscription(
        self,
        msg_type: Any,
        topic: str,
        callback: Callable[..., Any],
        qos_profile: QoSProfile | int,
        callback_group: CallbackGroup | None,
        raw: bool = False,
        sink: base.Sink | None = None,
        event_callbacks: SubscriptionEventCallbacks | None = None,
    ) -> Subscription:
        """Return a subscription that the caller owns."""
        profile = validate_qos(qos_profile)
        impl = self.announce("subscription", msg_type, topic, profile, sink=sink)
        with closed_on_error(impl):
            return Subscription(
                impl,
                msg_type,
                topic,
                callback=callback,
                qos_profile=profile,
                raw=raw,
                callback_group=callback_group or self.default_callback_group,
                event_callbacks=event_callbacks,
            )

    def make_client(
        self,
        srv_type: Any,
        srv_name: str,
        qos_profile: QoSProfile,
        callback_group: CallbackGroup | None,
    ) -> Client:
        """Return a client that the caller owns."""
        with closed_on_error(self.announce("client", srv_type, srv_name, qos_profile)) as impl:
            return Client(
                self._core.context,
                impl,
                srv_type,
                srv_name,
                qos_profile,
                callback_group or self.default_callback_group,
            )

    def make_service(
        self,
        srv_type: Any,
        srv_name: str,
        callback: Callable[..., Any],
        qos_profile: QoSProfile,
        callback_group: CallbackGroup | None,
        service_class: type[Service] = Service,
    ) -> Service:
        """Return a service that the caller owns."""
        check_is_valid_srv_type(srv_type)
        check_callable(callback)
        with closed_on_error(self.announce("service", srv_type, srv_name, qos_profile)) as impl:
            return service_class(
                impl,
                srv_type,
                srv_name,
                callback,
                qos_profile=qos_profile,
                callback_group=callback_group or self.default_callback_group,
            )

    def create_timer(
        self,
        period_sec: float,
        callback: Callable[[], Any] | None,
        callback_group: CallbackGroup | None,
        clock: Clock,
        autostart: bool,
    ) -> Timer:
        if callback is not None:
            check_callable(callback)
        check_open(self._core.context, "timer")
        # Truncated, not rounded, as in ROS 2.
        period_ns = int(float(period_sec) * 1_000_000_000)
        return self._own(
            Timer,
            Timer(
                callback,
                timer_period_ns=period_ns,
                clock=clock,
                context=self._core.context,
                autostart=autostart,
                callback_group=callback_group or self.default_callback_group,
            ),
        )

    def create_rate(self, frequency: float, clock: Clock) -> Rate:
        if frequency <= 0:
            raise ValueError("frequency must be > 0")
        # its own group: a callback that sleeps must not hold up the timer that wakes it
        timer = self.create_timer(
            1.0 / frequency, None, MutuallyExclusiveCallbackGroup(), clock, autostart=True
        )
        return Rate(timer, context=self._core.context)

    def create_guard_condition(
        self, callback: Callable[[], Any], callback_group: CallbackGroup | None
    ) -> GuardCondition:
        check_open(self._core.context, "guard_condition")
        group = callback_group or self.default_callback_group
        return self._own(GuardCondition, GuardCondition(callback, group, self._core.context))

    def add_waitable(self, waitable: Waitable) -> None:
        from rclpy.waitable import Waitable

        self._own(Waitable, waitable)

    def remove_waitable(self, waitable: Waitable) -> None:
        # Not destroyed: the waitable is the program's, which may add it to another node.
        executor = waitable._host()
        if executor is not None:
            executor.release(waitable)
        self._disown(waitable)

    def keep(self, resource: _Owned) -> _Owned:
        """Destroy ``resource`` together with the node; return it.

        It calls ``_on_destroy(itself)`` when it was destroyed before.
        """
        return self._own(type(resource), resource)

    def before_leaving(self, call: Callable[[], None]) -> Callable[[], None]:
        """Call ``call()`` before the node leaves the graph; return a function that undoes this.

        Unlike a resource given to :meth:`keep`, it is also called for a node that is garbage
        collected.
        """
        self._core.before_leaving[call] = None
        return lambda: self._core.before_leaving.pop(call, None)

    def _own(self, kind: type, owned: _Owned) -> _Owned:
        made: Any = owned
        with self._lock:
            self._owned.setdefault(kind, []).append(owned)
        made._on_destroy = self._disown
        membership = self._membership
        if membership is not None and isinstance(owned, Entity):
            executor = membership.host()
            if executor is not None:
                executor.adopt(owned, membership)
        return owned

    def attach(self, executor: EntityHost, node_index: int) -> None:
        """Let ``executor`` serve the entities, including entities made later.

        Args:
            executor: What serves them.
            node_index: Their node's place in the executor's order.
        """
        membership = self._membership
        former = None if membership is None else membership.host()
        if membership is not None and former is not None:
            if former is executor and membership.node_index == node_index:
                executor.take_back(membership)
                return
            former.end_membership(membership)
        # First: what another thread creates from here on is adopted there. Adopting twice is
        # harmless.
        self._membership = membership = Membership(executor, node_index)
        for entity in self.entities():
            executor.adopt(entity, membership)

    def detach(self, executor: EntityHost) -> None:
        """Undo :meth:`attach`."""
        membership = self._membership
        if membership is not None and membership.host() is executor:
            executor.park(membership)

    def _disown(self, owned: Any) -> None:
        with self._lock:
            for group in self._owned.values():
                if owned in group:
                    group.remove(owned)
                    return

    def destroy(self, kind: type, owned: Any) -> bool:
        """Close an endpoint; return False if it does not (or no longer) belong to this node."""
        if owned not in self.of(kind):
            return False
        owned.destroy()
        return True

    def destroy_all(self) -> None:
        """Close all endpoints."""
        with self._lock:
            everything = [owned for group in self._owned.values() for owned in group]
        # Without the lock: each endpoint removes itself with `_disown`.
        for owned in everything:
            owned.destroy()
