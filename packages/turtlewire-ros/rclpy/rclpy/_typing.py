"""Type variables of the public classes.

Each has a default, so that ``Publisher`` without brackets stays a valid annotation. Typed programs
import some of them from the public modules by ROS 2's names: ``MsgType``, ``SrvType`` …
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from typing_extensions import TypeVar

    from turtlewire.msg import Message

    T = TypeVar("T", default=Any)
    MsgT = TypeVar("MsgT", bound=Message, default=Any)
    SrvT = TypeVar("SrvT", default=Any)
    SrvT_co = TypeVar("SrvT_co", covariant=True, default=Any)
    ActionT_co = TypeVar("ActionT_co", covariant=True, default=Any)
    GoalT = TypeVar("GoalT")
    ResultT = TypeVar("ResultT")
    FeedbackT = TypeVar("FeedbackT")
    RequestT = TypeVar("RequestT")
    ResponseT = TypeVar("ResponseT")
else:  # the defaults came with Python 3.13
    from typing import TypeVar

    T, MsgT, SrvT = TypeVar("T"), TypeVar("MsgT"), TypeVar("SrvT")
    SrvT_co = TypeVar("SrvT_co", covariant=True)
    ActionT_co = TypeVar("ActionT_co", covariant=True)
    GoalT, ResultT, FeedbackT = TypeVar("GoalT"), TypeVar("ResultT"), TypeVar("FeedbackT")
    RequestT, ResponseT = TypeVar("RequestT"), TypeVar("ResponseT")
