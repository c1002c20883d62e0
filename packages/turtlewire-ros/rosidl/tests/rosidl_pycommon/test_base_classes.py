"""The base classes of interfaces."""

from __future__ import annotations

from rosidl_pycommon.interface_base_classes import BaseAction, BaseImpl, BaseMessage, BaseService
from std_msgs.msg import String
from std_srvs.srv import SetBool
from turtlesim.action import RotateAbsolute


def test_interfaces_have_their_bases():
    assert isinstance(String(), BaseMessage)
    assert isinstance(SetBool.Request(), BaseMessage)
    assert issubclass(RotateAbsolute.Goal, BaseMessage)
    assert issubclass(SetBool, BaseService)
    assert issubclass(RotateAbsolute, BaseAction)
    assert issubclass(RotateAbsolute.Impl, BaseImpl)
    assert not issubclass(SetBool, BaseMessage)
    assert RotateAbsolute.Impl.SendGoalService.Request().goal_id is not None
