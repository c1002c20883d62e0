"""Liveliness tokens: texts that announce nodes and endpoints."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["CLIENT", "NODE", "PUBLISHER", "SERVICE", "SUBSCRIPTION", "Token", "graph_key"]

NODE = "NN"
PUBLISHER = "MP"
SUBSCRIPTION = "MS"
SERVICE = "SS"
CLIENT = "SC"

_SPACE = "@ros2_lv"
_ENDPOINTS = (PUBLISHER, SUBSCRIPTION, SERVICE, CLIENT)
_NODE_FIELDS, _ENDPOINT_FIELDS = 9, 13


class Token(NamedTuple):
    """A node or an endpoint, as its liveliness token describes it.

    Attributes:
        domain_id: The domain.
        session: Id of the Zenoh session, in hexadecimal digits.
        node_id: Number of the node within the session.
        entity_id: Number of the endpoint; of a node, its own.
        kind: One of `NODE`, `PUBLISHER`, `SUBSCRIPTION`, `SERVICE` and `CLIENT`.
        enclave: Enclave of the node.
        namespace: Namespace of the node.
        node: Name of the node.
        name: Fully qualified name of the topic or service; empty for nodes.
        dds_type: ``std_msgs::msg::dds_::String_``; of a service, its own type.
        type_hash: ``RIHS01_`` and 64 digits.
        qos: See `qos_text`.
    """

    domain_id: int
    session: str
    node_id: str
    entity_id: str
    kind: str
    enclave: str
    namespace: str
    node: str
    name: str = ""
    dds_type: str = ""
    type_hash: str = ""
    qos: str = ""

    @property
    def text(self) -> str:
        """The key of the token."""
        mangled = [self.enclave, self.namespace, self.node]
        if self.kind != NODE:
            mangled += [self.name, self.dds_type, self.type_hash]
        fields = [_SPACE, str(self.domain_id), self.session, self.node_id, self.entity_id]
        fields += [self.kind, *(field.replace("/", "%") for field in mangled)]
        if self.kind != NODE:
            fields.append(self.qos)
        return "/".join(fields)

    @property
    def data_key(self) -> str:
        """The key that the messages, or requests and responses, of an endpoint have."""
        return f"{self.domain_id}/{self.name.strip('/')}/{self.dds_type}/{self.type_hash}"

    @property
    def gid(self) -> bytes:
        """16 bytes that anyone with the text can compute: XXH3 of it, low half first."""
        from xxhash import xxh3_128_digest

        return xxh3_128_digest(self.text.encode())[::-1]

    @classmethod
    def parse(cls, text: str) -> Token | None:
        """Read a token; None if the text is not a token or has an unknown kind.

        Newer versions may add fields at the end.
        """
        fields = text.split("/")
        if len(fields) < _NODE_FIELDS or fields[0] != _SPACE or "" in fields:
            return None
        _, domain_id, session, node_id, entity_id, kind, *mangled = fields
        if not domain_id.isdecimal():
            return None
        names = [field.replace("%", "/") for field in mangled]
        enclave, namespace, node, *rest = names
        token = cls(int(domain_id), session, node_id, entity_id, kind, enclave, namespace, node)
        if kind == NODE:
            return token
        if kind in _ENDPOINTS and len(fields) >= _ENDPOINT_FIELDS:
            name, dds_type, type_hash, qos = rest[:4]
            return token._replace(name=name, dds_type=dds_type, type_hash=type_hash, qos=qos)
        return None


def graph_key(domain_id: int) -> str:
    """Return the expression that all tokens of a domain meet."""
    return f"{_SPACE}/{domain_id}/**"
