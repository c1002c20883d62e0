"""Services that clients may call."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire.errors import CdrError
from turtlewire.msg import deserialize, get_message
from turtlewire.msg.json_messages import cdr_from_json, json_from_message
from turtlewire.wire.encapsulation import is_message
from turtlewire_view.foxglove.caller import ServiceCallError
from turtlewire_view.foxglove.protocol import ENCODINGS
from turtlewire_view.foxglove.schemas import ENCODING, schema

if TYPE_CHECKING:
    from turtlewire_view.foxglove.caller import Caller

__all__ = ["OfferedService", "offered_service"]


class OfferedService(NamedTuple):
    """A service and the number by which clients call it.

    Attributes:
        number: No other service of the server ever has it.
        name: Fully qualified name.
        type_name: ``std_srvs/srv/SetBool``.
        request_schema: Definition of the requests.
        response_schema: Definition of the responses.
    """

    number: int
    name: str
    type_name: str
    request_schema: str
    response_schema: str

    def advertisement(self) -> dict[str, Any]:
        """Return the announcement for clients; the last two fields are for older ones."""
        return {
            "id": self.number,
            "name": self.name,
            "type": self.type_name,
            "request": self._part("Request", self.request_schema),
            "response": self._part("Response", self.response_schema),
            "requestSchema": self.request_schema,
            "responseSchema": self.response_schema,
        }

    async def call(self, caller: Caller, encoding: str, request: bytes) -> bytes:
        """Return the response, in the encoding of the request.

        Raises:
            ServiceCallError: The request is wrong, or the service cannot be called.
            WireError: The wire refuses the request.
        """
        if encoding not in ENCODINGS:
            raise ServiceCallError(
                f"there is no encoding {encoding!r}; choose from {', '.join(ENCODINGS)}"
            )
        if encoding == "cdr":
            if not is_message(request):
                raise ServiceCallError(
                    f"the request's {len(request)} bytes are not little-endian CDR "
                    "(00 01 00 00, then the fields)"
                )
            return await caller.call(self.name, self.type_name, request)
        try:
            cdr = cdr_from_json(f"{self.type_name}_Request", request)
        except CdrError as error:
            raise ServiceCallError(str(error)) from error
        response = await caller.call(self.name, self.type_name, cdr)
        try:
            return json_from_message(
                deserialize(get_message(f"{self.type_name}_Response"), response)
            )
        except CdrError as error:
            raise ServiceCallError(f"the response cannot be read: {error}") from error

    def _part(self, part: str, definition: str) -> dict[str, str]:
        return {
            "encoding": "cdr",
            "schemaName": f"{self.type_name}_{part}",
            "schemaEncoding": ENCODING,
            "schema": definition,
        }


def offered_service(number: int, name: str, type_name: str) -> OfferedService:
    """Return a service with the definitions of its type.

    Raises:
        InterfaceError: The type is not known.
    """
    return OfferedService(
        number, name, type_name, schema(f"{type_name}_Request"), schema(f"{type_name}_Response")
    )
