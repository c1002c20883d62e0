"""The service through which other nodes ask how a type is defined."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from turtlewire import msg
from turtlewire.errors import InterfaceError
from turtlewire.msg.registry import interface_text

from .qos import qos_profile_services_default
from .validate_topic_name import TOPIC_SEPARATOR_STRING

if TYPE_CHECKING:
    from type_description_interfaces.msg import IndividualTypeDescription, TypeSource

    from ._node.views import ParameterOwner
    from .service import Service

__all__ = [
    "START_TYPE_DESCRIPTION_SERVICE_PARAM",
    "TOPIC_SEPARATOR_STRING",
    "TypeDescriptionService",
]

START_TYPE_DESCRIPTION_SERVICE_PARAM = "start_type_description_service"


class TypeDescriptionService:
    """Serves ``~/get_type_description``, unless the parameter that it declares is false."""

    def __init__(self, node: ParameterOwner) -> None:
        self._service: Service[Any] | None = None
        if not node.has_parameter(START_TYPE_DESCRIPTION_SERVICE_PARAM):
            from rcl_interfaces.msg import ParameterDescriptor

            descriptor = ParameterDescriptor(
                description="If enabled, start the ~/get_type_description service.", read_only=True
            )
            node.declare_parameter(START_TYPE_DESCRIPTION_SERVICE_PARAM, True, descriptor)
        if not node.get_parameter(START_TYPE_DESCRIPTION_SERVICE_PARAM).value:
            return
        from type_description_interfaces.srv import GetTypeDescription

        self._service = node.create_service(
            GetTypeDescription,
            TOPIC_SEPARATOR_STRING.join((node.get_name(), "get_type_description")),
            self._get_type_description,
            qos_profile=qos_profile_services_default,
        )

    def destroy(self) -> None:
        """Close the service. Idempotent."""
        if self._service is not None:
            self._service.destroy()

    def _get_type_description(self, request: Any, response: Any) -> Any:
        from turtlewire.msg.type_hash import referenced_types
        from type_description_interfaces.msg import TypeDescription

        try:
            expected = msg.type_hash(request.type_name)
        except InterfaceError:
            expected = None
        if not request.type_hash.startswith("RIHS01_"):
            response.failure_reason = "Failed to parse type hash"
        elif request.type_hash != expected:
            response.failure_reason = "Type not currently in use by this node"
        else:
            names = [request.type_name, *referenced_types(request.type_name)]
            main, *referenced = (_describe(name) for name in names)
            response.type_description = TypeDescription(
                type_description=main, referenced_type_descriptions=referenced
            )
            if request.include_type_sources:
                response.type_sources = [_source(name) for name in names]
            response.successful = True
        return response


def _describe(type_name: str) -> IndividualTypeDescription:
    from turtlewire.msg.registry import load_interface
    from turtlewire.msg.type_hash import field_type_parts, members
    from type_description_interfaces.msg import Field, FieldType, IndividualTypeDescription

    fields = []
    for name, type_ in members(load_interface(type_name)):
        type_id, capacity, string_capacity, nested = field_type_parts(type_)
        field_type = FieldType(
            type_id=type_id,
            capacity=capacity,
            string_capacity=string_capacity,
            nested_type_name=nested,
        )
        fields.append(Field(name=name, type=field_type))
    return IndividualTypeDescription(type_name=type_name, fields=fields)


def _source(type_name: str) -> TypeSource:
    """Return the definition's text; a part of a service or action has none of its own."""
    from type_description_interfaces.msg import TypeSource

    try:
        text = interface_text(type_name)
    except InterfaceError:
        return TypeSource(type_name=type_name, encoding="implicit")
    kind = type_name.split("/")[1]
    return TypeSource(type_name=type_name, encoding=kind, raw_file_contents=text)
