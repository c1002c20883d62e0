"""Restricts the server to requests of this machine's browsers for its own pages.

A browser sends in ``Host`` the name that it looked up and in ``Origin`` the page that makes the
request. A page of another site can make the user's browser connect to 127.0.0.1, also through a
host name that resolves to it (DNS rebinding). These two headers reveal both.

A server for the network answers to every address and to this computer's name besides. A page that
rebinds its own name still fails, and does not know the token (:mod:`turtlewire.web.lan`).

A server behind the proxy of a notebook service cannot know its own name. It relies on the token,
and compares the page with the name that the browser requested.
"""

from __future__ import annotations

import re
import socket

_LOOPBACK_NAMES = frozenset({"localhost", "[::1]"})
#: A name or an IPv6 address, with or without a port. The response quotes it in a header.
_HOST = re.compile(r"([a-z0-9._-]+|\[[0-9a-f:.]+\])(:[0-9]+)?", re.IGNORECASE)


def refusal(hosts: list[str], origins: list[str], *, lan: bool = False) -> str | None:
    """Return why a request is refused, as one sentence, or None if it is allowed.

    Args:
        hosts: All ``Host`` headers. Any port is allowed, as a forwarded port has another number.
        origins: All ``Origin`` headers. Programs other than browsers send none.
        lan: Whether other devices of the network are served, too.
    """
    name = _name(hosts[0]) if len(hosts) == 1 else ""
    if not _is_loopback(name) and not (lan and _is_of_this_computer(name)):
        known = "its addresses and its name" if lan else "localhost and 127.0.0.1"
        return f"Host is {_shown(hosts)}, this server answers only to {known}."
    if len(origins) > 1 or (origins and origins[0].lower() != f"http://{hosts[0].lower()}"):
        return f"Origin is {_shown(origins)}, this server answers only to its own pages."
    return None


def proxied_refusal(hosts: list[str], forwarded: list[str], origins: list[str]) -> str | None:
    """Return why a request is refused that needs the token and may come through a proxy.

    A page of the name that the browser requested is allowed with http and https, because a server
    behind several proxies does not see which of the two the browser used.

    Args:
        hosts: All ``Host`` headers.
        forwarded: All ``X-Forwarded-Host`` headers. A proxy that sends another ``Host`` names the
            requested host there, and a page of another site cannot set it.
        origins: All ``Origin`` headers.
    """
    if len(hosts) != 1 or not _HOST.fullmatch(hosts[0]):
        return f"Host is {_shown(hosts)}, expected one name."
    names = {name.strip().lower() for name in [*hosts, *",".join(forwarded).split(",")]} - {""}
    own = {f"{scheme}://{name}" for scheme in ("http", "https") for name in names}
    if len(origins) > 1 or (origins and origins[0].lower() not in own):
        return f"Origin is {_shown(origins)}, this server answers only to its own pages."
    return None


def _name(host: str) -> str:
    """Return the name in ``name``, ``name:port``, ``[v6]`` or ``[v6]:port``."""
    end = host.find("]") + 1 if host.startswith("[") else host.find(":")
    name, port = (host[:end], host[end:]) if end > 0 else (host, "")
    return name.lower() if not port or port[1:].isdecimal() else ""


def _is_loopback(name: str) -> bool:
    return name in _LOOPBACK_NAMES or (name.startswith("127.") and _is_ipv4(name))


def _is_of_this_computer(name: str) -> bool:
    """Return True if this is an IPv4 address, or this computer's name in whatever domain."""
    own = socket.gethostname().lower().partition(".")[0]
    return name.partition(".")[0] == own or _is_ipv4(name)


def _is_ipv4(name: str) -> bool:
    try:
        return socket.inet_ntoa(socket.inet_aton(name)) == name
    except OSError:
        return False


def _shown(values: list[str]) -> str:
    return ", ".join(repr(value) for value in values) or "missing"
