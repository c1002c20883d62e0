"""Types of type_description_interfaces.srv; generated."""

import service_msgs.msg
import type_description_interfaces.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "GetTypeDescription",
]

class GetTypeDescription_Request(Message):
    type_name: str
    type_hash: str
    include_type_sources: bool
    def __init__(
        self,
        *,
        type_name: str = ...,
        type_hash: str = ...,
        include_type_sources: bool = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetTypeDescription_Response(Message):
    successful: bool
    failure_reason: str
    type_description: type_description_interfaces.msg.TypeDescription
    type_sources: list[type_description_interfaces.msg.TypeSource]
    extra_information: list[type_description_interfaces.msg.KeyValue]
    def __init__(
        self,
        *,
        successful: bool = ...,
        failure_reason: str = ...,
        type_description: type_description_interfaces.msg.TypeDescription = ...,
        type_sources: list[type_description_interfaces.msg.TypeSource] = ...,
        extra_information: list[type_description_interfaces.msg.KeyValue] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetTypeDescription_Event(Message):
    info: service_msgs.msg.ServiceEventInfo
    request: list[GetTypeDescription_Request]
    response: list[GetTypeDescription_Response]
    def __init__(
        self,
        *,
        info: service_msgs.msg.ServiceEventInfo = ...,
        request: list[GetTypeDescription_Request] = ...,
        response: list[GetTypeDescription_Response] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class GetTypeDescription(Service[GetTypeDescription_Request, GetTypeDescription_Response]):
    Request: TypeAlias = GetTypeDescription_Request
    Response: TypeAlias = GetTypeDescription_Response
    Event: TypeAlias = GetTypeDescription_Event
