"""The base classes of interfaces, as ROS 2's package of this name from Lyrical on.

========================  ===========================================
module                    contents
========================  ===========================================
`interface_base_classes`  bases of messages, services and actions
========================  ===========================================
"""

from rosidl_pycommon.interface_base_classes import BaseAction, BaseImpl, BaseMessage, BaseService

__all__ = ["BaseAction", "BaseImpl", "BaseMessage", "BaseService"]
