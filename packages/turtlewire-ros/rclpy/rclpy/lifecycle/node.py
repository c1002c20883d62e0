"""Managed (lifecycle) nodes."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rclpy._rclpy_pybind11 import RCLError
from rclpy.node import Node
from turtlewire.distro import KILTED, since

from .managed_entity import ManagedEntity
from .publisher import LifecyclePublisher
from .state_machine import (
    STATES,
    TRANSITIONS,
    LifecycleState,
    StateMachine,
    Transition,
    TransitionCallbackReturn,
)

if TYPE_CHECKING:
    from rclpy.callback_groups import CallbackGroup
    from rclpy.publisher import Publisher

__all__ = ["LifecycleNode", "LifecycleNodeMixin", "LifecycleState"]

_SUCCESS = TransitionCallbackReturn.SUCCESS

#: State in which a callback runs, by the name of the callback.
_CALLBACK_STATES = {
    "on_configure": 10,
    "on_cleanup": 11,
    "on_shutdown": 12,
    "on_activate": 13,
    "on_deactivate": 14,
    "on_error": 15,
}


class LifecycleNodeMixin(ManagedEntity):
    """Makes a :class:`rclpy.node.Node` a managed one; see :class:`LifecycleNode`.

    Args:
        enable_communication_interface: Whether other nodes can see and change the state.
        callback_group: Of the services for that; None uses the node's default.
    """

    def __init__(
        self,
        *,
        enable_communication_interface: bool = True,
        callback_group: CallbackGroup | None = None,
    ) -> None:
        self._state_machine = StateMachine()
        self._managed_entities: list[ManagedEntity] = []
        self.__transition_event_publisher: Publisher | None = None
        self._callbacks: dict[int, Callable[[LifecycleState], TransitionCallbackReturn]] = {
            state: getattr(self, name) for name, state in _CALLBACK_STATES.items()
        }
        if enable_communication_interface:
            self.__offer_services(callback_group)

    def __offer_services(self, callback_group: CallbackGroup | None) -> None:
        from lifecycle_msgs import msg, srv

        node: Any = self
        self.__transition_event_publisher = node.create_publisher(
            msg.TransitionEvent, "~/transition_event", 10
        )
        for srv_type, name, callback in (
            (srv.ChangeState, "change_state", self.__on_change_state),
            (srv.GetState, "get_state", self.__on_get_state),
            (srv.GetAvailableStates, "get_available_states", self.__on_get_available_states),
            (
                srv.GetAvailableTransitions,
                "get_available_transitions",
                self.__on_get_available_transitions,
            ),
            (srv.GetAvailableTransitions, "get_transition_graph", self.__on_get_transition_graph),
        ):
            node.create_service(srv_type, f"~/{name}", callback, callback_group=callback_group)

    # Transitions

    def trigger_configure(self) -> TransitionCallbackReturn:
        """Go from unconfigured to inactive; in another state, RCLError, or from Kilted on ERROR."""
        return self.__request("configure")

    def trigger_cleanup(self) -> TransitionCallbackReturn:
        """Go from inactive to unconfigured; in another state, RCLError, or from Kilted on ERROR."""
        return self.__request("cleanup")

    def trigger_activate(self) -> TransitionCallbackReturn:
        """Go from inactive to active; in another state, RCLError, or from Kilted on ERROR."""
        return self.__request("activate")

    def trigger_deactivate(self) -> TransitionCallbackReturn:
        """Go from active to inactive; in another state, RCLError, or from Kilted on ERROR."""
        return self.__request("deactivate")

    def trigger_shutdown(self) -> TransitionCallbackReturn:
        """Go to finalized, from where no way leads on: RCLError there."""
        return self.__change_state(self._state_machine.by_label("shutdown"))

    def __request(self, label: str) -> TransitionCallbackReturn:
        try:
            transition = self._state_machine.by_label(label)
        except RCLError:
            if not since(KILTED):
                raise
            number = next(each.transition_id for each in TRANSITIONS if each.label == label)
            state = self._state_machine.current_state
            self.get_logger().error(  # type: ignore[attr-defined]
                f"Unable to start transition {number} from current state "
                f"{(state.state_id, state.label)}"
            )
            return TransitionCallbackReturn.ERROR
        return self.__change_state(transition)

    def __change_state(self, transition: Transition) -> TransitionCallbackReturn:
        before = self._state_machine.current_state
        self.__enter(transition.goal)
        # As in ROS 2, the callback gets the state before the transition.
        outcome = self.__run_callback(before)
        self.__enter(self._state_machine.by_label(outcome.to_label()).goal)
        # Now in the state errorprocessing: `on_error` decides between unconfigured and finalized.
        if outcome is TransitionCallbackReturn.ERROR:
            self.__enter(self._state_machine.by_label(self.__run_callback(before).to_label()).goal)
        return outcome

    def __enter(self, state: LifecycleState) -> None:
        start, self._state_machine.current_state = self._state_machine.current_state, state
        if self.__transition_event_publisher is not None:
            from lifecycle_msgs.msg import TransitionEvent

            event = TransitionEvent(
                start_state=_state_message(start), goal_state=_state_message(state)
            )
            self.__transition_event_publisher.publish(event)

    def __run_callback(self, before: LifecycleState) -> TransitionCallbackReturn:
        state = self._state_machine.current_state
        complain = self.get_logger().error  # type: ignore[attr-defined]
        try:
            outcome = self._callbacks[state.state_id](before)
        # An error is one of the outcomes that the state machine knows.
        except Exception as error:  # noqa: BLE001
            import traceback

            complain(
                f"Caught exception in callback for transition {state.label}: "
                f"{error}\n{traceback.format_exc()}"
            )
            return TransitionCallbackReturn.ERROR
        if not isinstance(outcome, TransitionCallbackReturn):
            complain(
                f"The callback for transition {state.label} has to return a "
                f"TransitionCallbackReturn, not {outcome!r}"
            )
            return TransitionCallbackReturn.ERROR
        return outcome

    # Callbacks

    def __forward(self, name: str, state: LifecycleState) -> TransitionCallbackReturn:
        """Notify the managed entities; the first one that does not succeed decides."""
        for entity in self._managed_entities:
            outcome: TransitionCallbackReturn = getattr(entity, name)(state)
            if outcome is not _SUCCESS:
                return outcome
        return _SUCCESS

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called to configure; programs override it."""
        return self.__forward("on_configure", state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called to undo the configuration; programs override it."""
        return self.__forward("on_cleanup", state)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called to shut down; programs override it."""
        return self.__forward("on_shutdown", state)

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called to activate.

        Programs that override it call it as well, it enables the publishers.
        """
        return self.__forward("on_activate", state)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called to deactivate.

        Programs that override it call it as well, it silences the publishers.
        """
        return self.__forward("on_deactivate", state)

    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called after an error; success leads to unconfigured, all else to finalized."""
        return self.__forward("on_error", state)

    def register_on_configure(
        self, cb: Callable[[LifecycleState], TransitionCallbackReturn]
    ) -> bool:
        """Call ``cb`` instead of :meth:`on_configure`."""
        return self.__register("on_configure", cb)

    def register_on_cleanup(self, cb: Callable[[LifecycleState], TransitionCallbackReturn]) -> bool:
        """Call ``cb`` instead of :meth:`on_cleanup`."""
        return self.__register("on_cleanup", cb)

    def register_on_shutdown(
        self, cb: Callable[[LifecycleState], TransitionCallbackReturn]
    ) -> bool:
        """Call ``cb`` instead of :meth:`on_shutdown`."""
        return self.__register("on_shutdown", cb)

    def register_on_activate(
        self, cb: Callable[[LifecycleState], TransitionCallbackReturn]
    ) -> bool:
        """Call ``cb`` instead of :meth:`on_activate`."""
        return self.__register("on_activate", cb)

    def register_on_deactivate(
        self, cb: Callable[[LifecycleState], TransitionCallbackReturn]
    ) -> bool:
        """Call ``cb`` instead of :meth:`on_deactivate`."""
        return self.__register("on_deactivate", cb)

    def register_on_error(self, cb: Callable[[LifecycleState], TransitionCallbackReturn]) -> bool:
        """Call ``cb`` instead of :meth:`on_error`."""
        return self.__register("on_error", cb)

    def __register(
        self, name: str, callback: Callable[[LifecycleState], TransitionCallbackReturn]
    ) -> bool:
        self._callbacks[_CALLBACK_STATES[name]] = callback
        return True

    # Managed entities

    def add_managed_entity(self, entity: ManagedEntity) -> None:
        """Let ``entity`` take part in transitions.

        Raises:
            TypeError: The argument is not a managed entity.
        """
        if not isinstance(entity, ManagedEntity):
            raise TypeError("Expected a rclpy.lifecycle.ManagedEntity instance.")
        self._managed_entities.append(entity)

    def create_lifecycle_publisher(self, *args: Any, **kwargs: Any) -> LifecyclePublisher:
        """Return a publisher that is silent while the node is not active.

        The arguments are the same as for ``create_publisher``.
        """
        if "publisher_class" in kwargs:
            raise TypeError(
                "create_publisher() got an unexpected keyword argument 'publisher_class'"
            )
        node: Any = self
        publisher: LifecyclePublisher = node.create_publisher(
            *args, **kwargs, publisher_class=LifecyclePublisher
        )
        self.add_managed_entity(publisher)
        return publisher

    def destroy_lifecycle_publisher(self, publisher: LifecyclePublisher) -> bool:
        """Close a publisher; False when it is not of this node."""
        if publisher in self._managed_entities:
            self._managed_entities.remove(publisher)
        node: Any = self
        return bool(node.destroy_publisher(publisher))

    # Services

    def __on_change_state(self, request: Any, response: Any) -> Any:
        wanted = request.transition
        try:
            machine = self._state_machine
            # As in ROS 2, the label goes before the number.
            transition = (
                machine.by_label(wanted.label) if wanted.label else machine.by_id(wanted.id)
            )
        except RCLError as error:
            self.get_logger().error(str(error))  # type: ignore[attr-defined]
            response.success = False
            return response
        response.success = self.__change_state(transition) is _SUCCESS
        return response

    # The signature of a service callback.
    def __on_get_state(self, request: Any, response: Any) -> Any:  # noqa: ARG002
        response.current_state = _state_message(self._state_machine.current_state)
        return response

    def __on_get_available_states(self, request: Any, response: Any) -> Any:  # noqa: ARG002
        response.available_states = [_state_message(state) for state in STATES.values()]
        return response

    def __on_get_available_transitions(self, request: Any, response: Any) -> Any:  # noqa: ARG002
        response.available_transitions = [
            _description(transition) for transition in self._state_machine.available_transitions
        ]
        return response

    def __on_get_transition_graph(self, request: Any, response: Any) -> Any:  # noqa: ARG002
        response.available_transitions = [_description(transition) for transition in TRANSITIONS]
        return response


class LifecycleNode(LifecycleNodeMixin, Node):
    """A node with states: unconfigured, inactive, active, finalized.

    Args:
        node_name: Base name.
        enable_communication_interface: Whether other nodes can see and change the state.
        **kwargs: The other arguments of :class:`rclpy.node.Node`.
    """

    def __init__(
        self, node_name: str, *, enable_communication_interface: bool = True, **kwargs: Any
    ) -> None:
        Node.__init__(self, node_name, **kwargs)
        LifecycleNodeMixin.__init__(
            self, enable_communication_interface=enable_communication_interface
        )


def _state_message(state: LifecycleState) -> Any:
    from lifecycle_msgs.msg import State

    return State(id=state.state_id, label=state.label)


def _description(transition: Transition) -> Any:
    from lifecycle_msgs import msg

    return msg.TransitionDescription(
        transition=msg.Transition(id=transition.transition_id, label=transition.label),
        start_state=_state_message(transition.start),
        goal_state=_state_message(transition.goal),
    )
