"""Types of rmw_dds_common.msg; generated."""

import numpy
import numpy.typing
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "Gid",
    "NodeEntitiesInfo",
    "ParticipantEntitiesInfo",
]

class Gid(Message):
    @property
    def data(self) -> numpy.typing.NDArray[numpy.uint8]: ...
    @data.setter
    def data(self, value: Iterable[Any]) -> None: ...
    def __init__(self, *, data: Iterable[Any] = ..., check_fields: bool = ...) -> None: ...

class NodeEntitiesInfo(Message):
    node_namespace: str
    node_name: str
    reader_gid_seq: list[Gid]
    writer_gid_seq: list[Gid]
    def __init__(
        self,
        *,
        node_namespace: str = ...,
        node_name: str = ...,
        reader_gid_seq: list[Gid] = ...,
        writer_gid_seq: list[Gid] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ParticipantEntitiesInfo(Message):
    gid: Gid
    node_entities_info_seq: list[NodeEntitiesInfo]
    def __init__(
        self,
        *,
        gid: Gid = ...,
        node_entities_info_seq: list[NodeEntitiesInfo] = ...,
        check_fields: bool = ...,
    ) -> None: ...
