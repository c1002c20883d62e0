"""Callbacks for changes of parameters: of all nodes, or of one parameter."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from turtlewire.wire import names

from .qos import QoSProfile, qos_profile_parameter_events

if TYPE_CHECKING:
    import rcl_interfaces.msg
    from rcl_interfaces.msg import ParameterEvent

    from .callback_groups import CallbackGroup
    from .event_handler import SubscriptionEventCallbacks
    from .node import Node
    from .qos_overriding_options import QoSOverridingOptions


class ParameterCallbackHandle:
    """A callback for one parameter.

    :meth:`ParameterEventHandler.remove_parameter_callback` takes it.
    """

    def __init__(
        self,
        parameter_name: str,
        node_name: str,
        callback: Callable[[rcl_interfaces.msg.Parameter], None],
    ) -> None:
        self.parameter_name = parameter_name
        self.node_name = node_name
        self.callback = callback


class ParameterEventCallbackHandle:
    """A callback for all events.

    :meth:`ParameterEventHandler.remove_parameter_event_callback` takes it.
    """

    def __init__(self, callback: Callable[[ParameterEvent], None]) -> None:
        self.callback = callback


class ParameterEventHandler:
    """Listens to ``/parameter_events``.

    The newest callback is called first, on the executor of ``node``.

    Args:
        node: The node that subscribes.
        qos_profile: Of the subscription, as the others.
        callback_group: See :meth:`rclpy.node.Node.create_subscription`, as for the others.
        event_callbacks: Called on events of the quality of service.
        qos_overriding_options: Which policies parameters may override.
        raw: Whether event callbacks get the serialized bytes; then there are no parameter
            callbacks.
    """

    class Callbacks:
        """The callbacks of a handler, the newest first.

        Attributes:
            parameter_callbacks: The callbacks for one parameter.
            event_callbacks: The callbacks for all events.
        """

        def __init__(self) -> None:
            self.parameter_callbacks: list[ParameterCallbackHandle] = []
            self.event_callbacks: list[ParameterEventCallbackHandle] = []

        def event_callback(self, event: Any) -> None:
            """Call the callbacks of an event; bytes have no parameter callbacks."""
            of_parameters = [] if isinstance(event, bytes) else list(self.parameter_callbacks)
            for handle in of_parameters:
                parameter = ParameterEventHandler.get_parameter_from_event(
                    event, handle.parameter_name, handle.node_name
                )
                if parameter is not None:
                    handle.callback(parameter)
            for each in list(self.event_callbacks):
                each.callback(event)

    def __init__(
        self,
        node: Node,
        qos_profile: QoSProfile = qos_profile_parameter_events,
        callback_group: CallbackGroup | None = None,
        event_callbacks: SubscriptionEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
    ) -> None:
        from rcl_interfaces.msg import ParameterEvent

        self.node = node
        self.qos_profile = qos_profile
        self._callbacks = self.Callbacks()
        self.parameter_event_subscription = node.create_subscription(
            ParameterEvent,
            "/parameter_events",
            self._callbacks.event_callback,
            qos_profile,
            callback_group=callback_group,
            event_callbacks=event_callbacks,
            qos_overriding_options=qos_overriding_options,
            raw=raw,
        )

    def destroy(self) -> None:
        """End the subscription."""
        self.node.destroy_subscription(self.parameter_event_subscription)

    def configure_nodes_filter(
        self,
        node_names: list[str] | None = None,  # noqa: ARG002 - no middleware here filters
    ) -> bool:
        """Ask the middleware for the events of some nodes only; without names, of all nodes.

        Returns:
            True if it filters. No middleware here does: the events of all nodes arrive, and
            callbacks for one parameter get only that.
        """
        return self.parameter_event_subscription.is_cft_supported

    @staticmethod
    def get_parameter_from_event(
        event: ParameterEvent, parameter_name: str, node_name: str
    ) -> rcl_interfaces.msg.Parameter | None:
        """Return the new or changed parameter of that name, if the event has it."""
        if event.node != node_name:
            return None
        found = [
            each
            for each in ParameterEventHandler.get_parameters_from_event(event)
            if each.name == parameter_name
        ]
        return found[0] if found else None

    @staticmethod
    def get_parameters_from_event(event: ParameterEvent) -> Iterable[rcl_interfaces.msg.Parameter]:
        """Yield all new and changed parameters of an event."""
        yield from event.new_parameters
        yield from event.changed_parameters

    def add_parameter_event_callback(
        self, callback: Callable[[ParameterEvent], None]
    ) -> ParameterEventCallbackHandle:
        """Call ``callback(event)`` for every event of every node."""
        handle = ParameterEventCallbackHandle(callback)
        self._callbacks.event_callbacks.insert(0, handle)
        return handle

    def remove_parameter_event_callback(self, handle: ParameterEventCallbackHandle) -> None:
        """Undo :meth:`add_parameter_event_callback`.

        Raises:
            RuntimeError: The callback was already removed.
        """
        if handle not in self._callbacks.event_callbacks:
            raise RuntimeError("Callback doesn't exist")
        self._callbacks.event_callbacks.remove(handle)

    def add_parameter_callback(
        self,
        parameter_name: str,
        node_name: str,
        callback: Callable[[rcl_interfaces.msg.Parameter], None],
    ) -> ParameterCallbackHandle:
        """Call ``callback(parameter)`` when a parameter is declared or changed.

        Args:
            parameter_name: Its name.
            node_name: Node that has it: fully qualified, relative to the own namespace, or empty
                for the own node.
            callback: Gets the message of the parameter.
        """
        handle = ParameterCallbackHandle(parameter_name, self._resolve(node_name), callback)
        self._callbacks.parameter_callbacks.insert(0, handle)
        return handle

    def remove_parameter_callback(self, handle: ParameterCallbackHandle) -> None:
        """Undo :meth:`add_parameter_callback`.

        Raises:
            RuntimeError: The callback was already removed.
        """
        if handle not in self._callbacks.parameter_callbacks:
            raise RuntimeError("Callback doesn't exist")
        self._callbacks.parameter_callbacks.remove(handle)

    def _resolve(self, node_name: str) -> str:
        if not node_name:
            return self.node.get_fully_qualified_name()
        return (
            node_name
            if node_name.startswith("/")
            else names.fully_qualified_node_name(node_name, self.node.get_namespace())
        )
