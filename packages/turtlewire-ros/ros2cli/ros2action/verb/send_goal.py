"""``ros2 action send_goal``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ros2action.verb import VerbExtension
from ros2cli.arguments import argument, exclusive, read_values, shortened
from ros2cli.completion import action_names, action_types, goal_values
from ros2cli.helpers import unsigned_int as non_negative_int
from ros2cli.node import NODE_NAME_PREFIX
from turtlewire.distro import LYRICAL, since

if TYPE_CHECKING:
    from rclpy.action import ActionClient
    from ros2cli.node.direct import DirectNode

__all__ = ["ARGUMENTS", "NODE_NAME_PREFIX", "SendGoalVerb", "main", "non_negative_int", "send_goal"]

_DEFAULT_CANCEL_TIMEOUT_S = 5.0


ARGUMENTS = (
    argument(
        "action_name",
        help="Name of the action, for example /turtle1/rotate_absolute",
        completer=action_names,
    ),
    argument(
        "action_type",
        help="Type of the action, for example turtlesim/action/RotateAbsolute",
        completer=action_types,
    ),
    exclusive(
        argument(
            "goal",
            nargs="?",
            default="{}",
            help="Values of the goal as YAML, for example '{theta: 1.57}'",
            completer=goal_values,
        ),
        argument("--stdin", action="store_true", help="Read the values from stdin"),
        required=True,
    ),
    argument("-f", "--feedback", action="store_true", help="Show the feedback"),
    argument(
        "-t",
        "--timeout",
        metavar="N",
        type=non_negative_int,
        help="Wait at most N seconds for the action server, in Lyrical also for each of its answers"
        " (default: no limit)",
    ),
)


def main(args: argparse.Namespace) -> str | None:
    """Send the goal, and print what becomes of it; Ctrl-C cancels it."""
    values = sys.stdin.read() if args.stdin else args.goal
    feedback_callback = _print_feedback if args.feedback else None
    return send_goal(args.action_name, args.action_type, values, feedback_callback, args.timeout)


def _print_feedback(message: Any) -> None:
    from rosidl_runtime_py import message_to_yaml

    print(f"Feedback:\n    {message_to_yaml(message.feedback)}")


def send_goal(
    action_name: str,
    action_type: str,
    goal_values: str,
    feedback_callback: Callable[[Any], Any] | None,
    timeout: float | None = None,
) -> str | None:
    """Send a goal from a new node, and print what becomes of it; Ctrl-C cancels it.

    Args:
        action_name: Name of the action.
        action_type: Its type, for example ``turtlesim/action/RotateAbsolute``.
        goal_values: Values of the goal as YAML.
        feedback_callback: Called with each feedback message; None asks for no feedback.
        timeout: Seconds to wait for the server, in Lyrical also for each of its answers; None
            waits without a limit.

    Returns:
        The text of an error, or None.

    Raises:
        KeyboardInterrupt: At Ctrl-C.
        RuntimeError: The type is not an action, the values are wrong, or the server did not answer.
    """
    from ros2cli.suggestion import field_meant
    from rosidl_runtime_py import set_message_fields

    action_class = _action_class(action_type)
    goal = action_class.Goal()
    values = read_values(goal_values)
    try:
        set_message_fields(goal, values)
    except Exception as error:  # noqa: BLE001  any value may be wrong in any way
        return f"Failed to populate message fields: {shortened(repr(error))}{field_meant(error)}"
    from rclpy.action import ActionClient
    from ros2cli.graph import actions
    from ros2cli.node.direct import DirectNode

    with DirectNode(None) as direct:
        known = actions(direct.graph)  # our own client is not among them
        client = ActionClient(direct.node, action_class, action_name)
        action = direct.node.resolve_topic_name(action_name)
        try:
            if not _wait_for_server(direct, client, action, known, timeout):
                return f"No server of the action '{action}' came within {timeout} s"
            # Up to Kilted, the time is that of the wait for a server.
            limit = timeout if since(LYRICAL) else None
            _run(direct, client, goal, f"action '{action_name}'", feedback_callback, limit)
        finally:
            client.destroy()
    return None


def _action_class(name: str) -> Any:
    from ros2cli.suggestion import interface_meant
    from rosidl_runtime_py.utilities import get_action

    try:
        return get_action(name)
    except (AttributeError, ModuleNotFoundError, ValueError):
        raise RuntimeError(
            f"The passed action type is invalid{interface_meant(name, 'action')}"
        ) from None


def _wait_for_server(
    direct: DirectNode,
    client: ActionClient[Any],
    action: str,
    known: list[tuple[str, list[str]]],
    timeout: float | None,
) -> bool:
    """Wait until a server is available; return False at the end of the time.

    Raises:
        KeyboardInterrupt: At Ctrl-C.
        UncallableServiceError: A server would misread the goal.
    """
    from ros2cli.suggestion import say_why_to_wait
    from turtlewire.wire.services import require_callable

    print("Waiting for an action server to become available...")
    service = f"{action}/_action/send_goal"
    # Before the wait, which a server that would misread the goal could never end.
    require_callable(direct.graph, service)
    if not client.server_is_ready():
        say_why_to_wait("action", action, client._action_type, known)
    if direct.wait_for_server(service, client.server_is_ready, timeout):
        return True
    if timeout is not None and direct.node.context.ok():
        return False
    # Without a limit, the wait ends without a server only at a signal.
    raise KeyboardInterrupt


def _run(
    direct: DirectNode,
    client: Any,
    goal: Any,
    server: str,
    feedback_callback: Callable[[Any], Any] | None,
    limit: float | None,
) -> None:
    from rosidl_runtime_py import message_to_yaml

    accepted = False
    # Feedback has its own topic, on which it may overtake the answer to the goal.
    early: list[Any] = []

    def show(message: Any) -> None:
        if not accepted:
            early.append(message)
        elif feedback_callback is not None:
            feedback_callback(message)

    print(f"Sending goal:\n     {message_to_yaml(goal)}")
    sent = client.send_goal_async(goal, show if feedback_callback else None)
    try:
        handle = direct.answer(sent, server, client.server_is_ready, limit)
    except TimeoutError:
        raise _timed_out("acceptance", limit) from None
    if not handle.accepted:
        print("Goal was rejected.")
        return
    print(f"Goal accepted with ID: {bytes(handle.goal_id.uuid).hex()}\n")
    accepted = True
    for message in early:
        show(message)
    result_future = handle.get_result_async()
    try:
        result = direct.answer(result_future, server, client.server_is_ready, limit)
    except (KeyboardInterrupt, TimeoutError) as error:
        _cancel(direct, handle, limit)
        if isinstance(error, TimeoutError):
            raise _timed_out("result", limit) from None
        raise
    direct.handle_received()  # the result may overtake feedback
    print(f"Result:\n    {message_to_yaml(result.result)}")
    print(f"Goal finished with status: {_status_name(result.status)}")


def _cancel(direct: DirectNode, handle: Any, limit: float | None) -> None:
    """Ask the server to stop, while the context is still open after Ctrl-C."""
    print("Canceling goal...")
    time_left = _DEFAULT_CANCEL_TIMEOUT_S if limit is None else limit
    try:
        response = direct.result(handle.cancel_goal_async(), time_left)
    except TimeoutError:
        if limit is None:
            raise
        raise _timed_out("cancellation", limit) from None
    if response.goals_canceling and list(response.goals_canceling[0].goal_id.uuid) == list(
        handle.goal_id.uuid
    ):
        print("Goal canceled.")
    else:
        print("Failed to cancel goal.")


def _timed_out(what: str, limit: float | None) -> RuntimeError:
    return RuntimeError(f"Timed out waiting for goal {what} after {limit} seconds.")


def _status_name(status: int) -> str:
    from action_msgs.msg import GoalStatus

    names = {
        getattr(GoalStatus, f"STATUS_{name}"): name for name in ("SUCCEEDED", "CANCELED", "ABORTED")
    }
    return names.get(status, "UNKNOWN")


class SendGoalVerb(VerbExtension, module=__name__):
    """Start an action and wait for its end."""
