"""Action servers."""

from __future__ import annotations

import threading
from collections.abc import Callable
from enum import Enum
from functools import partial
from typing import TYPE_CHECKING, Any

from rclpy._node.endpoints import endpoints_of
from rclpy._rclpy_pybind11 import InvalidHandle, RCLError
from rclpy.executors import await_or_execute
from rclpy.impl.hints import described, with_hint
from rclpy.impl.reexports import reexports
from rclpy.qos import QoSProfile, qos_profile_action_status_default, qos_profile_services_default
from rclpy.service import Service
from rclpy.service_introspection import IntrospectedAction
from rclpy.timer import Timer
from rclpy.type_support import check_for_type_support
from rclpy.waitable import Waitable
from turtlewire.distro import KILTED, LYRICAL, since
from turtlewire.msg import get_message

from ._goal_statuses import goal_key
from ._goals import Goal, GoalEvent, Goals
from .server_goal_handle import ServerGoalHandle

if TYPE_CHECKING:
    from rclpy._execution.entity import EntityHost
    from rclpy.callback_groups import CallbackGroup
    from rclpy.node import Node
    from rclpy.publisher import Publisher
    from rclpy.task import Future
    from turtlewire.wire.base import RequestId

__all__ = [
    "ActionServer",
    "CancelResponse",
    "GoalEvent",
    "GoalResponse",
    "ServerGoalHandle",
    "default_cancel_callback",
    "default_goal_callback",
    "default_handle_accepted_callback",
]

__getattr__ = reexports(__name__, {"action_msgs.msg": ("GoalInfo", "GoalStatus")})

_DEFAULT_RESULT_TIMEOUT_S = 10 if since(KILTED) else 900
_DEFAULT_FEEDBACK_QOS = QoSProfile(depth=10)
_DOES_NOTHING = "Not handling nor executing the goal, this server will do nothing"


class GoalResponse(Enum):
    """The decision of a goal callback."""

    REJECT = 1
    ACCEPT = 2


class CancelResponse(Enum):
    """The decision of a cancel callback."""

    REJECT = 1
    ACCEPT = 2


class _DeferredService(Service):
    """A service whose callback gets the id of the request, and answers it when it wants to."""

    def _answer(self, header: RequestId, request: Any) -> Any:
        return self.callback(header, request)


# The signature of a goal callback.
def default_goal_callback(goal_request: Any) -> GoalResponse:  # noqa: ARG001
    """Accept."""
    return GoalResponse.ACCEPT


def default_handle_accepted_callback(goal_handle: ServerGoalHandle) -> None:
    """Execute the goal at once."""
    goal_handle.execute()


def _leave_waiting(goal_handle: ServerGoalHandle) -> None:
    """Do nothing: the server has no callback that could execute the goal."""


# Likewise.
def default_cancel_callback(goal_handle: ServerGoalHandle) -> CancelResponse:  # noqa: ARG001
    """Reject."""
    return CancelResponse.REJECT


if not (TYPE_CHECKING or since(LYRICAL)):

    def default_cancel_callback(
        cancel_request: ServerGoalHandle,  # noqa: ARG001
    ) -> CancelResponse:
        """Reject."""
        return CancelResponse.REJECT


class ActionServer(IntrospectedAction, Waitable):
    """Executes goals of an action.

    Args:
        node: The node that offers the action.
        action_type: The action class.
        action_name: Name of the action.
        execute_callback: Called with a :class:`ServerGoalHandle`, returns the result; may be
            ``async``. None: the program ends each goal by its handle.
        callback_group: Of the other callbacks; None uses the node's default. Executions run
            outside of all groups.
        goal_callback: Called with the goal, decides whether it is accepted (default: yes).
        handle_accepted_callback: Called with the handle of an accepted goal (default: executes it).
        cancel_callback: Called with the handle of a goal that a client wants cancelled, decides
            whether it may (default: no).
        goal_service_qos_profile: Quality of service of goal requests.
        result_service_qos_profile: Quality of service of result requests.
        cancel_service_qos_profile: Quality of service of cancel requests.
        feedback_pub_qos_profile: Quality of service of feedback.
        status_pub_qos_profile: Quality of service of the goals' states.
        result_timeout: Seconds for which the result of a finished goal is kept; negative: no limit.
    """

    def __init__(
        self,
        node: Node,
        action_type: Any,
        action_name: str,
        execute_callback: Callable[[ServerGoalHandle], Any] | None = None,
        *,
        callback_group: CallbackGroup | None = None,
        goal_callback: Callable[[Any], Any] | None = default_goal_callback,
        handle_accepted_callback: Callable[[ServerGoalHandle], Any]
        | None = default_handle_accepted_callback,
        cancel_callback: Callable[[ServerGoalHandle], Any] | None = default_cancel_callback,
        goal_service_qos_profile: QoSProfile = qos_profile_services_default,
        result_service_qos_profile: QoSProfile = qos_profile_services_default,
        cancel_service_qos_profile: QoSProfile = qos_profile_services_default,
        feedback_pub_qos_profile: QoSProfile = _DEFAULT_FEEDBACK_QOS,
        status_pub_qos_profile: QoSProfile = qos_profile_action_status_default,
        result_timeout: float = _DEFAULT_RESULT_TIMEOUT_S,
    ) -> None:
        check_for_type_support(action_type)
        super().__init__(callback_group or node.default_callback_group)
        self._node = node
        self._action_type = action_type
        self._action_name = action_name
        self._logger = node.get_logger().get_child("action_server")
        self._goals = Goals(self._publish_statuses, self._publish_feedback, self._now_ns)
        self._lock = threading.Lock()
        self._waiting_executions: list[Callable[[], Any]] = []
        self._expires_ns: int | None = None
        self._result_timeout_ns = int(result_timeout * 1_000_000_000)
        self.register_goal_callback(goal_callback)
        if execute_callback is None and handle_accepted_callback in (
            None,
            default_handle_accepted_callback,
        ):
            self._logger.warning(_DOES_NOTHING)
            handle_accepted_callback = _leave_waiting
        self.register_handle_accepted_callback(handle_accepted_callback)
        self.register_cancel_callback(cancel_callback)
        self._execute_callback: Callable[[ServerGoalHandle], Any] | None = None
        if execute_callback is not None:
            self.register_execute_callback(execute_callback)
        self._make_endpoints(
            goal_service_qos_profile,
            result_service_qos_profile,
            cancel_service_qos_profile,
            feedback_pub_qos_profile,
            status_pub_qos_profile,
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
        self._goal_service = self._make_service(
            impl.SendGoalService, "send_goal", self._on_goal, goal_qos
        )
        self._cancel_service = self._make_service(
            impl.CancelGoalService, "cancel_goal", self._on_cancel, cancel_qos
        )
        self._result_service = self._make_service(
            impl.GetResultService, "get_result", self._on_result, result_qos
        )
        endpoints = endpoints_of(self._node)
        self._feedback_publisher = endpoints.make_publisher(
            impl.FeedbackMessage, f"{self._action_name}/_action/feedback", feedback_qos
        )
        self._status_publisher = endpoints.make_publisher(
            impl.GoalStatusMessage, f"{self._action_name}/_action/status", status_qos
        )
        clock = self._node.get_clock()
        self._expiry = Timer(
            self._expire_goals,
            callback_group=self.callback_group,
            timer_period_ns=0,
            clock=clock,
            context=self._node.context,
            autostart=False,
        )
        self._services = (self._goal_service, self._cancel_service, self._result_service)
        self._parts = [*self._services, self._expiry]

    def _make_service(
        self, service_type: Any, name: str, callback: Callable[..., Any], qos: QoSProfile
    ) -> Service:
        full_name = f"{self._action_name}/_action/{name}"
        return endpoints_of(self._node).make_service(
            service_type, full_name, callback, qos, self.callback_group, _DeferredService
        )

    @property
    def action_type(self) -> Any:
        """The action class."""
        return self._action_type

    def register_goal_callback(self, goal_callback: Callable[[Any], Any] | None = None) -> None:
        """Replace the goal callback; None uses the default."""
        self._goal_callback = goal_callback or default_goal_callback

    def register_handle_accepted_callback(
        self, handle_accepted_callback: Callable[[ServerGoalHandle], Any] | None = None
    ) -> None:
        """Replace the callback for accepted goals; None uses the default."""
        self._handle_accepted_callback = (
            handle_accepted_callback or default_handle_accepted_callback
        )

    def register_cancel_callback(
        self, cancel_callback: Callable[[ServerGoalHandle], Any] | None = None
    ) -> None:
        """Replace the cancel callback; None uses the default."""
        self._cancel_callback = cancel_callback or default_cancel_callback

    def register_execute_callback(
        self, execute_callback: Callable[[ServerGoalHandle], Any]
    ) -> None:
        """Replace the execute callback.

        Raises:
            TypeError: The callback is not callable.
        """
        if not callable(execute_callback):
            raise TypeError("Failed to register goal execution callback: not callable")
        self._execute_callback = execute_callback

    # Goals

    async def _on_goal(self, header: RequestId, request: Any) -> None:
        # A goal with an id that is in use is rejected without asking the program.
        is_new = self._goals.find(goal_key(request.goal_id)) is None
        accepted = is_new and await self._is_accepted(request.goal)
        # Before the response: the client may ask for the result at once.
        goal_handle = self._add_goal(request) if accepted else None
        response = self._action_type.Impl.SendGoalService.Response(accepted=goal_handle is not None)
        if goal_handle is None:
            self._goal_service._send_unless_destroyed(response, header)
            return
        response.stamp = goal_handle._goal.info.stamp
        self._goal_service._send_unless_destroyed(response, header)
        self._goals.publish_statuses()
        await await_or_execute(self._handle_accepted_callback, goal_handle)

    def _add_goal(self, request: Any) -> ServerGoalHandle | None:
        """Add a goal; None if another with its id was added while the goal callback decided."""
        info = get_message("action_msgs/msg/GoalInfo")(
            goal_id=request.goal_id, stamp=self._node.get_clock().now().to_msg()
        )
        try:
            return ServerGoalHandle(self, info, request.goal)
        except RCLError as error:
            uuid = request.goal_id.uuid
            self._logger.error(f"Failed to accept new goal with ID {uuid}: {error}")  # noqa: TRY400
            return None

    async def _is_accepted(self, goal: Any) -> bool:
        decision = await await_or_execute(self._goal_callback, goal)
        if not isinstance(decision, GoalResponse):
            self._logger.warning(
                "Goal request callback did not return a GoalResponse type. Rejecting goal."
            )
        return decision is GoalResponse.ACCEPT

    def notify_execute(
        self,
        goal_handle: ServerGoalHandle,
        execute_callback: Callable[[ServerGoalHandle], Any] | None = None,
    ) -> None:
        """Execute a goal on the executor; None uses the execute callback of the server.

        Between two spins of the node, the goal waits for the next one.

        Raises:
            AttributeError: The server has no execute callback.
        """
        goal = self._goals.find(goal_key(goal_handle.goal_id))
        callback = execute_callback or self._execute_callback
        if callback is None:
            error = AttributeError("'ActionServer' object has no attribute '_execute_callback'")
            raise with_hint(
                error, "Pass execute_callback to ActionServer, or a callback to execute()"
            )
        execution = partial(self._execute_goal, callback, goal_handle, goal)
        # Otherwise another thread could empty the list just before the execution is added to it.
        with self._lock:
            host = self._serving_host()
            if host is None:
                self._waiting_executions.append(execution)
                return
        host.create_task(execution)

    def _attach(self, host: EntityHost) -> None:
        super()._attach(host)
        self._start_waiting_executions(host)

    def _resume(self, host: EntityHost) -> None:
        self._start_waiting_executions(host)

    def _start_waiting_executions(self, host: EntityHost) -> None:
        with self._lock:
            waiting, self._waiting_executions = self._waiting_executions, []
        for execution in waiting:
            host.create_task(execution)

    async def _execute_goal(
        self,
        execute_callback: Callable[[ServerGoalHandle], Any],
        goal_handle: ServerGoalHandle,
        goal: Goal | None,
    ) -> None:
        why = "Goal state not set, assuming aborted."
        try:
            result = await await_or_execute(execute_callback, goal_handle)
            self._check_result(result)
        # The client has to get an answer.
        except Exception as error:  # noqa: BLE001
            result = self._action_type.Result()
            # A shutdown makes calls of the callback fail: that is not the callback's mistake.
            if isinstance(error, RCLError) and not self._node.context.is_open():
                why = "Goal not finished: the context was shut down."
            else:
                self._report(error)
        if goal_handle.is_active:
            self._logger.warning(f"{why} Goal ID: {goal_handle.goal_id.uuid}")
            goal_handle.abort()
        if goal is None:  # destroyed before it was executed: no client can ask for its result
            return
        self._send_goal_result(goal, result)

    def _send_goal_result(self, goal: Goal, result: Any) -> None:
        """Answer the clients that wait for the result, now and later; the first result counts."""
        if not goal.result.done():
            goal.result.set_result(
                self._action_type.Impl.GetResultService.Response(status=goal.status, result=result)
            )

    def _check_result(self, result: Any) -> None:
        if result is not None and not isinstance(result, self._action_type.Result):
            raise TypeError(
                f"The execute callback of action '{self._action_name}' has to return a "
                f"{self._action_type.__name__}.Result; it returned {described(result)}"
            )

    def _report(self, error: Exception) -> None:
        """Log an error of an execute callback with ROS 2's text, and show where it was raised."""
        import traceback

        self._logger.error(f"Error raised in execute callback: {error}")
        traceback.print_exception(error)

    def notify_goal_done(self) -> None:
        """Schedule the expiry of a finished goal's result."""
        self._schedule_expiry()

    # Results

    def _on_result(self, header: RequestId, request: Any) -> None:
        goal = self._goals.find(goal_key(request.goal_id))
        if goal is None:
            # An empty response has the status UNKNOWN: the goal never existed, or has expired.
            log = self._logger.warning if since(KILTED) else self._logger.debug
            log(f"Sending result response for unknown or expired goal ID: {request.goal_id.uuid}")
            self._result_service._send_unless_destroyed(
                self._action_type.Impl.GetResultService.Response(), header
            )
        else:
            goal.result.add_done_callback(partial(self._send_result, header))

    def _send_result(self, header: RequestId, result: Future) -> None:
        self._result_service._send_unless_destroyed(result.result(), header)

    def _schedule_expiry(self) -> None:
        if self._result_timeout_ns < 0 or self._destroyed:
            return
        first_end_ns = self._goals.first_end_ns()
        if first_end_ns is None:
            self._expires_ns = None
            self._expiry.cancel()
            return
        expires_ns = first_end_ns + self._result_timeout_ns
        if expires_ns != self._expires_ns:  # usually, the timer is already set when a goal ends
            self._expires_ns = expires_ns
            self._expiry.timer_period_ns = max(0, expires_ns - self._now_ns())
            self._expiry.reset()

    def _expire_goals(self) -> None:
        self._goals.forget_those_finished_by(self._now_ns() - self._result_timeout_ns)
        self._expires_ns = None
        self._schedule_expiry()

    # Cancelling

    async def _on_cancel(self, header: RequestId, request: Any) -> None:
        response = self._action_type.Impl.CancelGoalService.Response()
        wanted, response.return_code = self._goals.to_cancel(request.goal_info, response)
        for goal, goal_handle in wanted:
            decision = await await_or_execute(self._cancel_callback, goal_handle)
            if decision is CancelResponse.ACCEPT and self._begin_cancelling(goal):
                response.goals_canceling.append(goal.info)
        self._cancel_service._send_unless_destroyed(response, header)

    def _begin_cancelling(self, goal: Goal) -> bool:
        """Return False if the goal ended while the cancel callback decided."""
        try:
            self._goals.advance(goal, GoalEvent.CANCEL_GOAL)
        except RCLError:  # it has ended, or an earlier request has begun to cancel it
            return goal.is_active
        return True

    # Publishing

    def _publish_feedback(self, goal: Goal, feedback: Any) -> None:
        if not isinstance(feedback, self._action_type.Feedback):
            hint = (
                f"Feedback of action '{self._action_name}' is a "
                f"{self._action_type.__name__}.Feedback(), not {described(feedback)}"
            )
            raise with_hint(TypeError(), hint)
        message = self._action_type.Impl.FeedbackMessage(
            goal_id=goal.info.goal_id, feedback=feedback
        )
        self._publish_unless_destroyed(self._feedback_publisher, message)

    def _publish_statuses(self, cdr: bytes) -> None:
        self._publish_unless_destroyed(self._status_publisher, cdr)

    def _publish_unless_destroyed(self, publisher: Publisher[Any], message: Any) -> None:
        try:
            publisher.publish(message)
        except (InvalidHandle, RCLError):  # another thread may destroy the server at any moment
            if not self._destroyed:
                raise

    def _now_ns(self) -> int:
        return self._node.get_clock().now().nanoseconds

    def _close(self) -> None:
        super()._close()
        self._feedback_publisher.destroy()
        self._status_publisher.destroy()
