"""Types of rosbag2_interfaces.srv; generated."""

import builtin_interfaces.msg
import service_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "Burst",
    "GetRate",
    "IsPaused",
    "Pause",
    "Play",
    "PlayNext",
    "Resume",
    "Seek",
    "SetRate",
    "Snapshot",
    "SplitBagfile",
    "Stop",
    "TogglePaused",
]

class Burst_Request(Message):
    num_messages: int
    def __init__(self, *, num_messages: int = ..., check_fields: bool = ...) -> None: ...

class Burst_Response(Message):
    actually_burst: int
    def __init__(self, *, actually_burst: int = ..., check_fields: bool = ...) -> None: ...

class Burst_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[Burst_Request]
    response: list[Burst_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[Burst_Request] = ...,
        response: list[Burst_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Burst(Service[Burst_Request, Burst_Response]):
    Request: TypeAlias = Burst_Request
    Response: TypeAlias = Burst_Response
    Event: TypeAlias = Burst_Event

class GetRate_Request(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class GetRate_Response(Message):
    rate: float
    def __init__(self, *, rate: float = ..., check_fields: bool = ...) -> None: ...

class GetRate_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[GetRate_Request]
    response: list[GetRate_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[GetRate_Request] = ...,
        response: list[GetRate_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetRate(Service[GetRate_Request, GetRate_Response]):
    Request: TypeAlias = GetRate_Request
    Response: TypeAlias = GetRate_Response
    Event: TypeAlias = GetRate_Event

class IsPaused_Request(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class IsPaused_Response(Message):
    paused: bool
    def __init__(self, *, paused: bool = ..., check_fields: bool = ...) -> None: ...

class IsPaused_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[IsPaused_Request]
    response: list[IsPaused_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[IsPaused_Request] = ...,
        response: list[IsPaused_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class IsPaused(Service[IsPaused_Request, IsPaused_Response]):
    Request: TypeAlias = IsPaused_Request
    Response: TypeAlias = IsPaused_Response
    Event: TypeAlias = IsPaused_Event

class Pause_Request(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class Pause_Response(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class Pause_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[Pause_Request]
    response: list[Pause_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[Pause_Request] = ...,
        response: list[Pause_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Pause(Service[Pause_Request, Pause_Response]):
    Request: TypeAlias = Pause_Request
    Response: TypeAlias = Pause_Response
    Event: TypeAlias = Pause_Event

class Play_Request(Message):
    start_offset: builtin_interfaces.msg.Time
    playback_duration: builtin_interfaces.msg.Duration
    playback_until_timestamp: builtin_interfaces.msg.Time
    def __init__(
        self,
        *,
        start_offset: builtin_interfaces.msg.Time = ...,
        playback_duration: builtin_interfaces.msg.Duration = ...,
        playback_until_timestamp: builtin_interfaces.msg.Time = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Play_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ..., check_fields: bool = ...) -> None: ...

class Play_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[Play_Request]
    response: list[Play_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[Play_Request] = ...,
        response: list[Play_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Play(Service[Play_Request, Play_Response]):
    Request: TypeAlias = Play_Request
    Response: TypeAlias = Play_Response
    Event: TypeAlias = Play_Event

class PlayNext_Request(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class PlayNext_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ..., check_fields: bool = ...) -> None: ...

class PlayNext_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[PlayNext_Request]
    response: list[PlayNext_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[PlayNext_Request] = ...,
        response: list[PlayNext_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PlayNext(Service[PlayNext_Request, PlayNext_Response]):
    Request: TypeAlias = PlayNext_Request
    Response: TypeAlias = PlayNext_Response
    Event: TypeAlias = PlayNext_Event

class Resume_Request(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class Resume_Response(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class Resume_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[Resume_Request]
    response: list[Resume_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[Resume_Request] = ...,
        response: list[Resume_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Resume(Service[Resume_Request, Resume_Response]):
    Request: TypeAlias = Resume_Request
    Response: TypeAlias = Resume_Response
    Event: TypeAlias = Resume_Event

class Seek_Request(Message):
    time: builtin_interfaces.msg.Time
    def __init__(
        self,
        *,
        time: builtin_interfaces.msg.Time = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Seek_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ..., check_fields: bool = ...) -> None: ...

class Seek_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[Seek_Request]
    response: list[Seek_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[Seek_Request] = ...,
        response: list[Seek_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Seek(Service[Seek_Request, Seek_Response]):
    Request: TypeAlias = Seek_Request
    Response: TypeAlias = Seek_Response
    Event: TypeAlias = Seek_Event

class SetRate_Request(Message):
    rate: float
    def __init__(self, *, rate: float = ..., check_fields: bool = ...) -> None: ...

class SetRate_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ..., check_fields: bool = ...) -> None: ...

class SetRate_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[SetRate_Request]
    response: list[SetRate_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[SetRate_Request] = ...,
        response: list[SetRate_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SetRate(Service[SetRate_Request, SetRate_Response]):
    Request: TypeAlias = SetRate_Request
    Response: TypeAlias = SetRate_Response
    Event: TypeAlias = SetRate_Event

class Snapshot_Request(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class Snapshot_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ..., check_fields: bool = ...) -> None: ...

class Snapshot_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[Snapshot_Request]
    response: list[Snapshot_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[Snapshot_Request] = ...,
        response: list[Snapshot_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Snapshot(Service[Snapshot_Request, Snapshot_Response]):
    Request: TypeAlias = Snapshot_Request
    Response: TypeAlias = Snapshot_Response
    Event: TypeAlias = Snapshot_Event

class SplitBagfile_Request(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class SplitBagfile_Response(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class SplitBagfile_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[SplitBagfile_Request]
    response: list[SplitBagfile_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[SplitBagfile_Request] = ...,
        response: list[SplitBagfile_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class SplitBagfile(Service[SplitBagfile_Request, SplitBagfile_Response]):
    Request: TypeAlias = SplitBagfile_Request
    Response: TypeAlias = SplitBagfile_Response
    Event: TypeAlias = SplitBagfile_Event

class Stop_Request(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class Stop_Response(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class Stop_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[Stop_Request]
    response: list[Stop_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[Stop_Request] = ...,
        response: list[Stop_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Stop(Service[Stop_Request, Stop_Response]):
    Request: TypeAlias = Stop_Request
    Response: TypeAlias = Stop_Response
    Event: TypeAlias = Stop_Event

class TogglePaused_Request(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class TogglePaused_Response(Message):
    def __init__(self, *, check_fields: bool = ...) -> None: ...

class TogglePaused_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[TogglePaused_Request]
    response: list[TogglePaused_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[TogglePaused_Request] = ...,
        response: list[TogglePaused_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class TogglePaused(Service[TogglePaused_Request, TogglePaused_Response]):
    Request: TypeAlias = TogglePaused_Request
    Response: TypeAlias = TogglePaused_Response
    Event: TypeAlias = TogglePaused_Event
