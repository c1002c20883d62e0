"""Which requests are answered: those of this machine's browsers for a page of this server.

A browser sends in ``Host`` the name that it looked up and in ``Origin`` the page that makes the
request. A foreign page can make the user's browser connect to 127.0.0.1, also under a name of its
own that resolves to it (DNS rebinding). These two headers reveal both.
"""

from __future__ import annotations

__all__ = ["refusal"]

_LOOPBACK_NAMES = frozenset({"127.0.0.1", "localhost", "[::1]"})


def refusal(hosts: list[str], origins: list[str]) -> str | None:
    """Why a request is refused, as one sentence, or None if it is allowed.

    Args:
        hosts: All ``Host`` headers. Any port is allowed, as a forwarded port has another number.
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
