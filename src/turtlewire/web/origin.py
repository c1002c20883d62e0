"""Which requests are answered: those that this machine's browser makes for a page of ours.

A browser tells in ``Host`` which name it looked up and in ``Origin`` whose page makes the request.
A page of a stranger can make the user's browser talk to 127.0.0.1, also under a name of its own
that resolves to it (DNS rebinding); neither gets past these two headers.
"""

from __future__ import annotations

__all__ = ["refusal"]

_LOOPBACK_NAMES = frozenset({"127.0.0.1", "localhost", "[::1]"})


def refusal(hosts: list[str], origins: list[str]) -> str | None:
    """Why a request is refused, as one sentence, or None when it is welcome.

    Args:
        hosts: All ``Host`` headers. Any port is fine, as a forwarded port has another number.
        origins: All ``Origin`` headers. Programs other than browsers send none.
    """
    if len(hosts) != 1 or _name(hosts[0]) not in _LOOPBACK_NAMES:
        return f"Host is {_shown(hosts)}, this server answers only to localhost and 127.0.0.1."
    if len(origins) > 1 or (origins and origins[0].lower() != f"http://{hosts[0].lower()}"):
        return f"Origin is {_shown(origins)}, this server answers only to its own pages."
    return None


def _name(host: str) -> str:
    """The name in ``name``, ``name:port``, ``[v6]`` or ``[v6]:port``."""
    end = host.find("]") + 1 if host.startswith("[") else host.find(":")
    name, port = (host[:end], host[end:]) if end > 0 else (host, "")
    return name.lower() if not port or port[1:].isdecimal() else ""


def _shown(values: list[str]) -> str:
    return ", ".join(repr(value) for value in values) or "missing"
