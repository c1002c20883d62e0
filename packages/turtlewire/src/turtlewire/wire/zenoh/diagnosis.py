"""Explains why a session cannot be opened, because Zenoh only says "Timeout!".

Each address is tried again with Python's own sockets and TLS, and the same certificates.
"""

from __future__ import annotations

import json
import re
import socket
import threading
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire.wire.report import warn_once

if TYPE_CHECKING:
    import ssl

    import zenoh

_LIMIT_S = 10.0
_TLS = "transport/link/tls"
_FILES = ("root_ca_certificate", "connect_certificate", "connect_private_key")
_ADDRESS = r"(?P<protocol>\w+)/\[?(?P<host>[^\]#?]+?)\]?:(?P<port>\d+)([#?].*)?"
_FORM = 'An address is PROTOCOL/HOST:PORT: connect/endpoints=["tcp/robot.example:7447"].'
_ORIGIN = (
    "It is a setting in the file that ZENOH_SESSION_CONFIG_URI names, or in ZENOH_CONFIG_OVERRIDE."
)
#: One byte that is not a Zenoh message: a peer that accepted the certificate closes the connection.
_NO_MESSAGE = b"\x01\x00\x00"

#: What OpenSSL calls the reasons for which the other side ends a handshake.
_ALERTS = {
    "CERTIFICATE_REQUIRED": (
        "the other side requires a certificate (mutual TLS), but none was presented",
        f"set {_TLS}/connect_certificate, connect_private_key and enable_mtls=true.",
    ),
    "UNKNOWN_CA": (
        "the other side does not know the authority that signed {certificate}",
        "Have the certificate signed by the authority of the router's root_ca_certificate.",
    ),
    "CERTIFICATE_EXPIRED": (
        "{certificate} has expired",
        "Have a new one signed; a clock that is wrong has the same effect.",
    ),
}
#: What OpenSSL says of the certificate of the other side.
_VERIFIED = {
    "has expired": (
        "the certificate of the other side has expired",
        "Have a new one signed for the router; a clock that is wrong has the same effect.",
    ),
    "mismatch": (
        "the certificate of the other side is for another name than {host}",
        "Connect to a name or address in its subjectAltName, or sign one for this name.",
    ),
    "doesn't match": (
        "the certificate of the other side is for another name than {host}",
        "Connect to a name or address in its subjectAltName, or sign one for this name.",
    ),
    "": (
        "the certificate of the other side is not signed by {authority}",
        f"Let {_TLS}/root_ca_certificate name the authority that signed the router's certificate.",
    ),
}


class ConnectFault(NamedTuple):
    """The reason why a session cannot connect to an address.

    Attributes:
        text: What is wrong.
        remedy: What to do.
    """

    text: str
    remedy: str


class _Address(NamedTuple):
    text: str
    protocol: str
    host: str
    port: int


def fault_of(configuration: zenoh.Config, reason: str) -> ConnectFault:
    """Return why a session cannot be opened, given Zenoh's ``reason``."""
    if not re.match("Unable to connect|Timeout", reason, re.IGNORECASE):
        return ConnectFault(reason, _ORIGIN)
    addresses = list(_flat(_value(configuration, "connect/endpoints")))
    if not addresses:
        return ConnectFault("connect/endpoints names no router, and none was found", _FORM)
    for text in addresses:
        address = _parsed(text)
        if address is not None:
            fault = _link_fault(address, configuration) or _session_fault(address, configuration)
            return fault._replace(text=f"{text}: {fault.text}")
    return ConnectFault(f"connect/endpoints: {addresses[0]} is not a reachable address", _FORM)


def warn_of_faults(configuration: zenoh.Config) -> None:
    """Warn, from a thread, of each TLS address that cannot be connected to.

    Zenoh tries such an address again and again, and says nothing.
    """

    def check() -> None:
        for address in encrypted:
            fault = _link_fault(address, configuration)
            if fault is not None:
                warn_once(address.text, f"{address.text}: {fault.text}. {fault.remedy}")

    addresses = map(_parsed, _flat(_value(configuration, "connect/endpoints")))
    encrypted = [one for one in addresses if one is not None and one.protocol == "tls"]
    if encrypted:
        threading.Thread(target=check, name="turtlewire-tls", daemon=True).start()


def _parsed(text: str) -> _Address | None:
    """Return an address with a port."""
    parts = re.fullmatch(_ADDRESS, text)
    if parts is None:
        return None
    return _Address(text, parts["protocol"], parts["host"], int(parts["port"]))


def _flat(endpoints: Any) -> Iterator[str]:
    """Endpoints may be lists for each mode, and lists of alternatives."""
    if isinstance(endpoints, str):
        yield endpoints
    elif endpoints:
        for part in endpoints.values() if isinstance(endpoints, dict) else endpoints:
            yield from _flat(part)


def _value(configuration: zenoh.Config, key: str) -> Any:
    return json.loads(configuration.get_json(key))


def _link_fault(address: _Address, configuration: zenoh.Config) -> ConnectFault | None:
    """Return the problem below Zenoh: files, network or TLS."""
    tls = _value(configuration, _TLS) or {}
    encrypted = address.protocol in ("tls", "quic")
    context = _context(tls) if encrypted else None
    if (
        isinstance(context, ConnectFault) or address.protocol == "quic"
    ):  # which Python does not speak
        return context if isinstance(context, ConnectFault) else None
    try:
        with socket.create_connection((address.host, address.port), _LIMIT_S) as plain:
            return None if context is None else _handshake_fault(plain, address, context, tls)
    except (OSError, UnicodeError) as error:  # the latter for a host such as `a..b`
        return ConnectFault(
            f"no connection ({getattr(error, 'strerror', None) or error})",
            "Is the router running there (`ros2 run rmw_zenoh_cpp rmw_zenohd`), does it listen at "
            "that address, and does the firewall let TCP through?",
        )


def _context(tls: dict[str, Any]) -> ssl.SSLContext | ConnectFault:
    """Return Python's TLS context, or the problem of a file."""
    import ssl

    shows_certificate = tls.get("enable_mtls") and tls.get("connect_certificate")
    for key in _FILES if shows_certificate else _FILES[:1]:
        path = tls.get(key)
        if not path:
            continue
        try:
            with open(path, "rb"):
                pass
        except OSError as error:
            return ConnectFault(
                f"{path} cannot be read: {error.strerror}", f"{_TLS}/{key} names it."
            )
    try:
        context = ssl.create_default_context(cafile=tls.get("root_ca_certificate"))
    except ssl.SSLError:
        return ConnectFault(
            f"{tls['root_ca_certificate']} holds no certificate",
            f"{_TLS}/root_ca_certificate names it; it must be PEM.",
        )
    # Strict is Python's default from 3.13 on; Zenoh takes certificates without key identifiers.
    context.verify_flags &= ~ssl.VERIFY_X509_STRICT
    context.check_hostname = tls.get("verify_name_on_connect") is not False
    if shows_certificate:
        certificate, private_key = tls["connect_certificate"], tls.get("connect_private_key")
        try:
            context.load_cert_chain(certificate, private_key)
        except ssl.SSLError:
            return ConnectFault(
                f"{certificate} and {private_key} are not a matching certificate and key",
                f"{_TLS}/connect_certificate and connect_private_key name them.",
            )
    return context


def _handshake_fault(
    plain: socket.socket, address: _Address, context: ssl.SSLContext, tls: dict[str, Any]
) -> ConnectFault | None:
    import ssl

    names = {
        "host": address.host,
        "authority": tls.get("root_ca_certificate") or "an authority that this system knows",
        "certificate": tls.get("connect_certificate") or "the certificate",
    }
    try:
        with context.wrap_socket(plain, server_hostname=address.host) as encrypted:
            # With TLS 1.3 the other side looks at our certificate after our handshake has ended.
            encrypted.sendall(_NO_MESSAGE)
            encrypted.recv(1)
    except ssl.SSLCertVerificationError as error:
        said = next(part for part in _VERIFIED if part in error.verify_message)
        return _named(_VERIFIED[said], names)
    except ssl.SSLError as error:
        alert = next((name for name in _ALERTS if name in (error.reason or "")), None)
        if alert:
            return _named(_ALERTS[alert], names)
        return ConnectFault(
            f"the other side ends the TLS handshake ({error.reason or error})",
            "Does it listen with tls/? Its terminal says more with RUST_LOG=zenoh=warn.",
        )
    except OSError:  # it hangs up, as it should
        return None
    return None


def _named(sentence: tuple[str, str], names: dict[str, str]) -> ConnectFault:
    text, remedy = sentence
    return ConnectFault(text.format(**names), remedy)


def _session_fault(address: _Address, configuration: zenoh.Config) -> ConnectFault:
    """Return the problem of a session whose link works."""
    user = _value(configuration, "transport/auth/usrpwd/user")
    if user:
        return ConnectFault(
            f"the other side rejects user {user!r} with this password",
            "A line user:password must be in the file that transport/auth/usrpwd/dictionary_file "
            "of the router names.",
        )
    kind = "" if address.protocol == "tls" else ", or requires TLS (tls/HOST:PORT)"
    return ConnectFault(
        "the peer at that address opened no session",
        "It is not a Zenoh router, or it requires a user and password "
        f"(transport/auth/usrpwd){kind}.",
    )
