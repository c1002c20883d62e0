"""The class of ``ros2 action send_goal``."""

from __future__ import annotations

from ros2action.verb import VerbExtension
from ros2cli.builtin import BuiltinVerb
from ros2cli.node import NODE_NAME_PREFIX

__all__ = ["NODE_NAME_PREFIX", "SendGoalVerb"]


class SendGoalVerb(BuiltinVerb, VerbExtension):
    """Start an action and wait for its end."""

    _module = "action.send_goal"
