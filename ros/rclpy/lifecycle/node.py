"""Managed nodes: their work starts and stops by transitions that other programs can trigger."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy._rclpy_pybind11 import RCLError
from rclpy.node import Node

from .managed_entity import ManagedEntity
from .publisher import LifecyclePublisher
from .state_machine import LifecycleState, StateMachine, TransitionCallbackReturn

if TYPE_CHECKING:
    from collections.abc import Iterable

    import lifecycle_msgs.msg
    from rclpy.callback_groups import CallbackGroup
    from rclpy.publisher import Publisher

    from .state_machine import Transition

__all__ = ["LifecycleNode", "LifecycleNodeMixin"]

#: The state in which a callback runs, and the name of the callback.
_CALLBACKS = {
    "configuring": "on_configure",
    "cleaningup": "on_cleanup",
    "shuttingdown": "on_shutdown",
    "activating": "on_activate",
    "deactivating": "on_deactivate",
    "errorprocessing": "on_error",
}


class LifecycleNodeMixin(ManagedEntity):
    """What makes a node a managed one; :class:`LifecycleNode` is the whole.

    Args:
        enable_communication_interface: Whether other nodes can ask for its state and trigger transitions.
        callback_group: Of the services for that.
    """

    def __init__(self, *, enable_communication_interface: bool = True, callback_group: CallbackGroup | None = None) -> None:
        self._state_machine = StateMachine()
        self._managed_entities: dict[ManagedEntity, None] = {}
        self._transition_event_publisher: Publisher | None = None
        if enable_communication_interface:
            self._create_communication_interface(callback_group)

    def trigger_configure(self) -> TransitionCallbackReturn:
        """Go from unconfigured to inactive; :class:`RCLError` when the node is in another state, as with the others."""
        return self._change_state("configure")

    def trigger_cleanup(self) -> TransitionCallbackReturn:
        """Go from inactive to unconfigured."""
        return self._change_state("cleanup")

    def trigger_activate(self) -> TransitionCallbackReturn:
        """Go from inactive to active."""
        return self._change_state("activate")

    def trigger_deactivate(self) -> TransitionCallbackReturn:
        """Go from active to inactive."""
        return self._change_state("deactivate")

    def trigger_shutdown(self) -> TransitionCallbackReturn:
        """Go from unconfigured, inactive or active to finalized."""
        if all(transition.label != "shutdown" for transition in self._state_machine.available_transitions):
            raise RCLError("Shutdown transition not possible")
        return self._change_state("shutdown")

    def add_managed_entity(self, entity: ManagedEntity) -> None:
        """Let ``entity`` hear of the transitions, as long as the node's own callbacks call those of this class."""
        self._managed_entities[entity] = None

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called at ``configure``; this one calls those of the managed entities and stops at the first that does not succeed."""
        return self._ask_entities("on_configure", state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called at ``cleanup``; see :meth:`on_configure`."""
        return self._ask_entities("on_cleanup", state)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called at ``shutdown``; see :meth:`on_configure`."""
        return self._ask_entities("on_shutdown", state)

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called at ``activate``; see :meth:`on_configure`."""
        return self._ask_entities("on_activate", state)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called at ``deactivate``; see :meth:`on_configure`."""
        return self._ask_entities("on_deactivate", state)

    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called when another callback ends in an error: SUCCESS leads to unconfigured, all else to finalized."""
        return self._ask_entities("on_error", state)

    def create_lifecycle_publisher(self, *args: Any, **kwargs: Any) -> LifecyclePublisher:
        """Create a publisher that is silent while the node is not active; arguments as :meth:`Node.create_publisher`."""
        if "publisher_class" in kwargs:
            raise TypeError("create_publisher() got an unexpected keyword argument 'publisher_class'")
        publisher = self.create_publisher(*args, **kwargs, publisher_class=LifecyclePublisher)
        self.add_managed_entity(publisher)
        return publisher

    def destroy_lifecycle_publisher(self, publisher: LifecyclePublisher) -> bool:
        """Destroy it; False when it is not of this node."""
        self._managed_entities.pop(publisher, None)
        return self.destroy_publisher(publisher)

    def _ask_entities(self, callback: str, state: LifecycleState) -> TransitionCallbackReturn:
        for entity in list(self._managed_entities):
            answer = getattr(entity, callback)(state)
            if answer is not TransitionCallbackReturn.SUCCESS:
                return answer if isinstance(answer, TransitionCallbackReturn) else TransitionCallbackReturn.ERROR
        return TransitionCallbackReturn.SUCCESS

    def _change_state(self, which: int | str) -> TransitionCallbackReturn:
        """Go through a transition and its callback, and through that of errors if it ends in one; returns how the first ended."""
        before = self._state_machine.current_state
        self._trigger(which)
        answer = self._run_callback(before)
        self._trigger(answer.to_label())
        if answer is TransitionCallbackReturn.ERROR:
            self._trigger(self._run_callback(before).to_label())
        return answer

    def _trigger(self, which: int | str) -> None:
        transition = self._state_machine.trigger(which)
        if self._transition_event_publisher is not None:
            from lifecycle_msgs.msg import TransitionEvent

            event = TransitionEvent(timestamp=self.get_clock().now().nanoseconds, transition=_transition_msg(transition))
            event.start_state, event.goal_state = _state_msg(transition.start), _state_msg(transition.goal)
            self._transition_event_publisher.publish(event)

    def _run_callback(self, before: LifecycleState) -> TransitionCallbackReturn:
        name = _CALLBACKS[self._state_machine.current_state.label]
        try:
            answer = getattr(self, name)(before)
        except Exception as error:  # noqa: BLE001 - whatever it is, the node goes to errorprocessing
            import traceback

            self.get_logger().error(f"{name}() raised an exception: {''.join(traceback.format_exception(error)).rstrip()}")
            return TransitionCallbackReturn.ERROR
        if not isinstance(answer, TransitionCallbackReturn):
            self.get_logger().error(f"{name}() returned {answer!r}; it has to return a TransitionCallbackReturn")
            return TransitionCallbackReturn.ERROR
        return answer

    def _create_communication_interface(self, callback_group: CallbackGroup | None) -> None:
        from lifecycle_msgs.msg import TransitionEvent
        from lifecycle_msgs.srv import ChangeState, GetAvailableStates, GetAvailableTransitions, GetState

        self._transition_event_publisher = self.create_publisher(TransitionEvent, "~/transition_event", 10)
        for service_type, name, callback in (
            (ChangeState, "~/change_state", self._on_change_state),
            (GetState, "~/get_state", self._on_get_state),
            (GetAvailableStates, "~/get_available_states", self._on_get_available_states),
            (GetAvailableTransitions, "~/get_available_transitions", self._on_get_available_transitions),
            (GetAvailableTransitions, "~/get_transition_graph", self._on_get_transition_graph),
        ):
            self.create_service(service_type, name, callback, callback_group=callback_group)

    def _on_change_state(self, request: Any, response: Any) -> Any:
        try:
            answer = self._change_state(request.transition.label or request.transition.id)
        except RCLError as error:  # the state machine has logged why; ROS 2 would end the whole program here
            self.get_logger().error(str(error))
            answer = TransitionCallbackReturn.FAILURE
        response.success = answer is TransitionCallbackReturn.SUCCESS
        return response

    def _on_get_state(self, _request: Any, response: Any) -> Any:
        response.current_state = _state_msg(self._state_machine.current_state)
        return response

    def _on_get_available_states(self, _request: Any, response: Any) -> Any:
        response.available_states = [_state_msg(state) for state in self._state_machine.available_states]
        return response

    def _on_get_available_transitions(self, _request: Any, response: Any) -> Any:
        response.available_transitions = _descriptions(self._state_machine.available_transitions)
        return response

    def _on_get_transition_graph(self, _request: Any, response: Any) -> Any:
        response.available_transitions = _descriptions(self._state_machine.transition_graph)
        return response


class LifecycleNode(LifecycleNodeMixin, Node):
    """A managed node; arguments as :class:`rclpy.node.Node`, and whether other nodes can trigger its transitions."""

    def __init__(self, node_name: str, *, enable_communication_interface: bool = True, **kwargs: Any) -> None:
        Node.__init__(self, node_name, **kwargs)
        LifecycleNodeMixin.__init__(self, enable_communication_interface=enable_communication_interface)


def _state_msg(state: LifecycleState) -> lifecycle_msgs.msg.State:
    from lifecycle_msgs.msg import State

    return State(id=state.state_id, label=state.label)


def _transition_msg(transition: Transition) -> lifecycle_msgs.msg.Transition:
    from lifecycle_msgs.msg import Transition as TransitionMsg

    return TransitionMsg(id=transition.transition_id, label=transition.label)


def _descriptions(transitions: Iterable[Transition]) -> list[lifecycle_msgs.msg.TransitionDescription]:
    from lifecycle_msgs.msg import TransitionDescription

    return [
        TransitionDescription(
            transition=_transition_msg(transition), start_state=_state_msg(transition.start), goal_state=_state_msg(transition.goal)
        )
        for transition in transitions
    ]
