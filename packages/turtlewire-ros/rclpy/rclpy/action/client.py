"""Action clients."""

from __future__ import annotations

import math
import threading
import time
import weakref
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Generic

from rclpy._execution.blocking import limit_ns
from rclpy._node.checks import check_valid
from rclpy._node.endpoints import endpoints_of
from rclpy._typing import ActionT_co
from rclpy.impl.hints import described, with_hint
from rclpy.impl.reexports import reexports
from rclpy.qos import QoSProfile, qos_profile_action_status_default, qos_profile_services_default
from rclpy.service_introspection import IntrospectedAction
from rclpy.task import Future
from rclpy.type_support import check_for_type_support
from rclpy.waitable import Waitable
from turtlewire.distro import KILTED, since
from turtlewire.errors import CdrError

from ._goal_statuses import goal_key, random_goal_id, read_statuses
from ._goals import ACTIVE_STATES

if TYPE_CHECKING:
    from rclpy._typing import FeedbackT, GoalT, ResultT
    from rclpy.callback_groups import CallbackGroup
    from rclpy.client import Client
    from rclpy.node import Node
    from rclpy.subscription import MessageInfo
    from turtlewire.msg import Action

__getattr__ = reexports(
    __name__,
    {
        "action_msgs.msg": ("GoalStatus",),
        "action_msgs.srv": ("CancelGoal",),
        "builtin_interfaces.msg": ("Time",),
        "unique_identifier_msgs.msg": ("UUID",),
        "rclpy.executors": ("await_or_execute",),
    },
)

#: Feedback may come later than a result that was sent after it: the callbacks of this many finished
#: goals are kept.
_FINISHED_GOALS = 100
_DEFAULT_FEEDBACK_QOS = QoSProfile(depth=10)


class ClientGoalHandle:
    """A goal that was sent, with its state; it can be cancelled, and gives its result.

    Thread-safe.
    """

    def __init__(self, action_client: ActionClient, goal_id: Any, goal_response: Any) -> None:
        self._action_client = action_client
        self._goal_id = goal_id
        self._goal_response = goal_response
        self._status = 0

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ClientGoalHandle) and self._goal_id == other.goal_id

    def __hash__(self) -> int:
        return hash(goal_key(self._goal_id))

    def __repr__(self) -> str:
        return (
            f"ClientGoalHandle <id={goal_key(self._goal_id).hex()}, accepted={self.accepted}, "
            f"status={self.status}>"
        )

    @property
    def goal_id(self) -> Any:
        """Identifies the goal (``unique_identifier_msgs/msg/UUID``)."""
        return self._goal_id

    @property
    def stamp(self) -> Any:
        """Time of acceptance by the server (``builtin_interfaces/msg/Time``)."""
        return self._goal_response.stamp

    @property
    def accepted(self) -> bool:
        """True if the server accepted it."""
        return bool(self._goal_response.accepted)

    @property
    def status(self) -> int:
        """The last known state, a number of ``action_msgs/msg/GoalStatus``."""
        return self._status

    def cancel_goal(self) -> Any:
        """Ask the server to cancel it, and block for the answer (``CancelGoal.Response``).

        Another thread has to spin.
        """
        return self._action_client._block_for(self.cancel_goal_async())

    def cancel_goal_async(self) -> Future:
        """Ask the server to cancel it; a future of the answer (``CancelGoal.Response``)."""
        return self._action_client._cancel_goal_async(self)

    def get_result(self) -> Any:
        """Block until it is finished; the response has ``status`` and ``result``.

        Another thread has to spin.
        """
        return self._action_client._block_for(self.get_result_async())

    def get_result_async(self) -> Future:
        """Return a future of the response, which has ``status`` and ``result``."""
        return self._action_client._get_result_async(self)


class ActionClient(IntrospectedAction, Waitable, Generic[ActionT_co]):
    """Sends goals to an action server. Thread-safe.

    Args:
        node: The node that owns it.
        action_type: The action class.
        action_name: Name of the action.
        callback_group: Of feedback callbacks; None uses the node's default.
        goal_service_qos_profile: Quality of service of goal requests.
        result_service_qos_profile: Quality of service of result requests.
        cancel_service_qos_profile: Quality of service of cancel requests.
        feedback_sub_qos_profile: Quality of service of feedback.
        status_sub_qos_profile: Quality of service of the goals' states.
        enable_feedback_msg_optimization: Has no effect: the middlewares here do not filter by
            content, so that the feedback of other clients' goals arrives and is dropped.
    """

    def __init__(
        self,
        node: Node,
        action_type: type[ActionT_co],
        action_name: str,
        *,
        callback_group: CallbackGroup | None = None,
        goal_service_qos_profile: QoSProfile = qos_profile_services_default,
        result_service_qos_profile: QoSProfile = qos_profile_services_default,
        cancel_service_qos_profile: QoSProfile = qos_profile_services_default,
        feedback_sub_qos_profile: QoSProfile = _DEFAULT_FEEDBACK_QOS,
        status_sub_qos_profile: QoSProfile = qos_profile_action_status_default,
        enable_feedback_msg_optimization: bool = False,  # noqa: ARG002 - no middleware here filters
    ) -> None:
        check_for_type_support(action_type)
        super().__init__(callback_group or node.default_callback_group)
        self._node = node
        self._action_type: Any = action_type
        self._action_name = action_name
        self._lock = threading.Lock()
        # Weak, as in ROS 2: a handle that the program has dropped needs no updates.
        self._goal_handles: weakref.WeakValueDictionary[bytes, ClientGoalHandle] = (
            weakref.WeakValueDictionary()
        )
        self._feedback_callbacks: dict[bytes, Callable[[Any], Any]] = {}
        #: Feedback that was sent later is ignored.
        self._finished_ns: dict[bytes, float] = {}
        self._make_endpoints(
            goal_service_qos_profile,
            result_service_qos_profile,
            cancel_service_qos_profile,
            feedback_sub_qos_profile,
            status_sub_qos_profile,
        )
        node.add_waitable(self)

    def _make_endpoints(
        self,
        goal_qos: QoSProfile,
        result_qos: QoSProfile,
        cancel_qos: QoSProfile,
        feedback_qos: QoSProfile,
        status_qos: QoSProfile,
    ) -> None:
        impl = self._action_type.Impl
        self._goal_client = self._make_client(impl.SendGoalService, "send_goal", goal_qos)
        self._cancel_client = self._make_client(impl.CancelGoalService, "cancel_goal", cancel_qos)
        self._result_client = self._make_client(impl.GetResultService, "get_result", result_qos)
        self._services = (self._goal_client, self._cancel_client, self._result_client)
        subscribe = endpoints_of(self._node).make_subscription
        name, group = f"{self._action_name}/_action", self.callback_group
        self._feedback = subscribe(
            impl.FeedbackMessage,
            f"{name}/feedback",
            self._on_feedback,
            feedback_qos,
            group,
        )
        self._status = subscribe(
            impl.GoalStatusMessage,
            f"{name}/status",
            self._on_status,
            status_qos,
            group,
            # Undecoded: a message has the states of all goals, of which few concern this client.
            raw=True,
        )
        # If several parts are ready at once, the response to the goal comes first, then feedback,
        # then the result.
        self._parts = [
            self._goal_client,
            self._cancel_client,
            self._feedback,
            self._result_client,
            self._status,
        ]

    def _make_client(self, service_type: Any, name: str, qos: QoSProfile) -> Client:
        return endpoints_of(self._node).make_client(
            service_type, f"{self._action_name}/_action/{name}", qos, self.callback_group
        )

    def server_is_ready(self) -> bool:
        """Return True if an action server is available; RCLError after a shutdown."""
        check_valid(self._node.context, "Failed to check if action server is available")
        return (
            self._goal_client.service_is_ready()
            and self._cancel_client.service_is_ready()
            and self._result_client.service_is_ready()
            and self._feedback.get_publisher_count() > 0
            and self._status.get_publisher_count() > 0
        )

    def wait_for_server(self, timeout_sec: float | None = None) -> bool:
        """Block until an action server is available (no polling).

        Args:
            timeout_sec: None or infinite waits without a limit, 0 or negative does not wait.

        Returns:
            True if a server is available, False after the timeout.

        Raises:
            RCLError: The context was shut down, before or during the wait.
        """
        return self._node.context.wait_for_graph(self._look_for_server, limit_ns(timeout_sec))

    def _look_for_server(self) -> bool:
        """Return True if a server is available; logs once why an existing one is not called."""
        if self.server_is_ready():
            return True
        self._goal_client._look_for_server()
        return False

    def send_goal_async(
        self: ActionClient[Action[GoalT, ResultT, FeedbackT]],
        goal: GoalT,
        feedback_callback: Callable[[Any], Any] | None = None,
        goal_uuid: Any = None,
    ) -> Future:
        """Send a goal.

        Args:
            goal: The goal.
            feedback_callback: Called with each feedback message (``.feedback``, ``.goal_id``),
                except messages sent after the program got the result.
            goal_uuid: Identifies the goal; None uses a random one.

        Returns:
            A future of a :class:`ClientGoalHandle`.

        Raises:
            TypeError: ``goal`` is not a ``Goal`` of the action.
        """
        if not isinstance(goal, self._action_type.Goal):
            hint = (
                f"A goal of action '{self._action_name}' is a "
                f"{self._action_type.__name__}.Goal(), not {described(goal)}"
            )
            raise with_hint(self._wrong_goal(goal), hint)
        request = self._action_type.Impl.SendGoalService.Request(
            goal=goal, goal_id=goal_uuid or random_goal_id()
        )
        goal_id = goal_key(request.goal_id)
        # Before the request, because feedback may arrive sooner than the response.
        if feedback_callback is not None:
            self._feedback_callbacks[goal_id] = feedback_callback
        future = Future()
        response = self._goal_client.call_async(request)
        response._add_waiter(lambda: self._on_goal_response(request.goal_id, response, future))
        return future

    def _wrong_goal(self, goal: Any) -> TypeError:
        """Return ROS 2's error; Jazzy's has no text, and later ones name the type's metaclass."""
        if not since(KILTED):
            return TypeError()
        goal_type = self._action_type.Goal
        expected = f"<class '{goal_type.__module__}.Metaclass_{goal_type.__name__}'>"
        return TypeError(f"Expected goal type ({expected}) but received ({type(goal)})")

    def _on_goal_response(self, goal_id: Any, response: Future, future: Future) -> None:
        # The program's done-callbacks run on the executor, not in the thread that got the response.
        self.add_future(future)
        error = response.exception()
        if error is not None:
            future.set_exception(error)
            return
        if response.cancelled():
            future.cancel()
            return
        handle = ClientGoalHandle(self, goal_id, response.result())
        key = goal_key(goal_id)
        if handle.accepted:
            with self._lock:
                if key in self._goal_handles:
                    future.set_exception(
                        RuntimeError(f"Two goals were accepted with the same ID ({handle})")
                    )
                    return
                self._goal_handles[key] = handle
        else:
            self._feedback_callbacks.pop(key, None)
        future.set_result(handle)

    def send_goal(
        self: ActionClient[Action[GoalT, ResultT, FeedbackT]],
        goal: GoalT,
        feedback_callback: Callable[[Any], Any] | None = None,
        goal_uuid: Any = None,
    ) -> Any:
        """Send a goal and block until it is finished; another thread has to spin.

        Returns:
            The response with ``status`` and ``result``, or None when the goal was rejected.

        Raises:
            TypeError: ``goal`` is not a ``Goal`` of the action.
        """
        sent = self.send_goal_async(goal, feedback_callback, goal_uuid)
        handle = self._block_for(sent)
        return handle.get_result() if handle.accepted else None

    def _block_for(self, future: Future) -> Any:
        return self._goal_client._block_for(future, None)

    def _cancel_goal_async(self, goal_handle: ClientGoalHandle) -> Future:
        if not isinstance(goal_handle, ClientGoalHandle):
            raise TypeError(f"Expected type ClientGoalHandle but received {type(goal_handle)}")
        request = self._action_type.Impl.CancelGoalService.Request()
        request.goal_info.goal_id = goal_handle.goal_id
        return self._cancel_client.call_async(request)

    def _get_result_async(self, goal_handle: ClientGoalHandle) -> Future:
        if not isinstance(goal_handle, ClientGoalHandle):
            raise TypeError(f"Expected type ClientGoalHandle but received {type(goal_handle)}")
        request = self._action_type.Impl.GetResultService.Request(goal_id=goal_handle.goal_id)
        response = self._result_client.call_async(request)
        response._add_waiter(lambda: self._on_result(goal_handle, response))
        return response

    def _on_result(self, goal_handle: ClientGoalHandle, response: Future) -> None:
        # Not `exception()`, which would mark an error as retrieved by the program.
        if response.done() and not response.cancelled() and response._exception is None:
            goal_handle._status = response.result().status
            with self._lock:
                self._finished_ns[goal_key(goal_handle.goal_id)] = time.time_ns()
                self._forget_old_goals()

    def _forget_old_goals(self) -> None:
        """Forget the callbacks of all but the last finished goals. The caller holds the lock."""
        while len(self._finished_ns) > _FINISHED_GOALS:
            oldest = next(iter(self._finished_ns))
            del self._finished_ns[oldest]
            self._feedback_callbacks.pop(oldest, None)

    def _on_feedback(self, message: Any, info: MessageInfo) -> Any:
        key = goal_key(message.goal_id)
        sent_ns = info["source_timestamp"]
        # Sent after the result arrived: the program has finished with the goal.
        if sent_ns > self._finished_ns.get(key, sent_ns):
            return None
        callback = self._feedback_callbacks.get(key)
        return None if callback is None else callback(message)

    def _on_status(self, cdr: bytes) -> None:
        with self._lock:
            unfinished = self._feedback_callbacks.keys() - self._finished_ns.keys()
            goals = unfinished | set(self._goal_handles)
        try:
            states = read_statuses(cdr, goals)
        except CdrError as error:
            self._node.get_logger().error(
                f"Ignoring a malformed message on topic '{self._status.topic}': {error}",
                throttle_duration_sec=5.0,
            )
            return
        for key, status in states:
            handle = self._goal_handles.get(key)
            if handle is not None:
                handle._status = status
            if status not in ACTIVE_STATES:
                with self._lock:
                    self._goal_handles.pop(key, None)
                    # The program may never ask for the result.
                    if key in self._feedback_callbacks:
                        self._finished_ns.setdefault(key, math.inf)
                    self._forget_old_goals()
