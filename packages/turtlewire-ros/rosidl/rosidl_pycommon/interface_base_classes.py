"""Bases of messages, services and actions: for ``isinstance``, ``issubclass`` and annotations."""

from turtlewire.msg import Action as BaseAction
from turtlewire.msg import ActionImpl as BaseImpl
from turtlewire.msg import Message as BaseMessage
from turtlewire.msg import Service as BaseService

__all__ = ["BaseAction", "BaseImpl", "BaseMessage", "BaseService"]
