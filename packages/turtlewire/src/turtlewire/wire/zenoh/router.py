"""A router: a Zenoh session with the configuration of rmw_zenohd, and the wait for one.

The log of a router's library is reworded where it tells of rejected peers: Zenoh logs to standard
output, which is replaced by a pipe; the reworded sentences go to standard error. With ``RUST_LOG``,
the log is left as it is.

rmw_zenoh looks for a router even when ``ZENOH_ROUTER_CHECK_ATTEMPTS`` is unset. Sessions here find
each other without one, so an unset variable means no check.
"""

from __future__ import annotations

import os
import re
import signal
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import TextIO

import zenoh
from zenoh import SampleKind, WhatAmI
from zenoh.handlers import Callback

from turtlewire.errors import WireError
from turtlewire.program import open_output
from turtlewire.wire.report import warn, warn_once

from .configuration import router_configuration
from .diagnosis import warn_of_faults
from .library import reason_of

_FILTER = (
    "error,zenoh_link_tls=warn,zenoh_link_quic=warn,"
    "zenoh_transport::unicast::establishment::accept=debug,"
    "zenoh::net::routing::interceptor::access_control=info"
)
_COLORS = r"\x1b\[[0-9;]*m"
_HEAD = r"^\S+ +(?P<level>[A-Z]+) .*?(?P<module>zenoh\w*(?:::\w+)+)(?:\{.*?\})?: (?P<text>.*)$"
_PLACE = r"(\.? at \S+\.rs:\d+\.?| Hint: increase the system open file limit\.)+$"
#: What a kind of line says, and the sentence for it; it is repeated after this many seconds.
_PERIOD_S = 60.0
_SENTENCES = {
    r"invalid peer certificate: UnknownIssuer": "refused a connection: its certificate is not "
    "signed by an authority in transport/link/tls/root_ca_certificate",
    r"invalid peer certificate: .*[Ee]xpired.*": "refused a connection: its certificate has "
    "expired; sign a new one, and compare the clocks",
    r"peer sent no certificates": "refused a connection: it presents no certificate, and "
    r"transport/link/tls/enable_mtls requires one",
    r"received fatal alert: (UnknownCA|BadCertificate|CertificateUnknown)": "a peer hung up: it "
    "does not know the authority that signed this router's certificate",
    r"received fatal alert: CertificateExpired": "a peer hung up: this router's certificate has "
    "expired",
    r"received corrupt message.*": "refused a connection without TLS: the address that the peer "
    "connects to must begin with tls/",
    r"tls handshake eof": "",
    # Peers of older versions take back twice what they declared. Nothing is lost by it.
    r"Unknown (interest|subscriber|token)\b.*": "",
    r"UsrPwd .*Invalid (user|password).*": "refused a session: its user and password are not in "
    "the file that transport/auth/usrpwd/dictionary_file names",
    r"UsrPwd .*Expected extension.*": "refused a session: it gives no user and password "
    "(transport/auth/usrpwd/user and password)",
    r"(?P<zid>\w+) did not match any configured ACL subject.*": "session {zid} matches no subject "
    "of access_control, so all that it does is dropped: add its user name or its certificate's "
    "common name to 'subjects', and a policy for it",
}


def explain(line: str) -> str:
    """Return a line of Zenoh's log as a sentence; empty if it is of no use."""
    line = re.sub(_COLORS, "", line)
    parts = re.match(_HEAD, line)
    if parts is None:
        return line
    text = re.sub(_PLACE, "", parts["text"]).rstrip(".")
    for pattern, sentence in _SENTENCES.items():
        told = re.fullmatch(pattern, text)
        if told:
            return sentence.format(**told.groupdict())
    return text if parts["level"] in ("WARN", "ERROR") else ""


@contextmanager
def explained_log() -> Iterator[TextIO]:
    """Translate the library's log into sentences; once in a process.

    Yields:
        Standard output.
    """
    zenoh.init_log_from_env_or(_FILTER)
    if "RUST_LOG" in os.environ:
        yield sys.stdout
        return
    sys.stdout.flush()
    reading, writing = os.pipe()
    with open_output(os.dup(1)) as output:
        os.dup2(writing, 1)
        os.close(writing)
        thread = threading.Thread(target=_pass_on, args=(reading,), name="turtlewire-log")
        thread.start()
        try:
            yield output
        finally:
            os.dup2(output.fileno(), 1)  # closes the end to write to, which ends the thread
            thread.join()


def _pass_on(reading: int) -> None:
    said: dict[str, float] = {}
    with os.fdopen(reading, encoding="utf-8", errors="replace") as lines:
        for line in lines:
            sentence = explain(line.rstrip("\n"))
            now = time.monotonic()
            if sentence and now - said.get(sentence, -_PERIOD_S) >= _PERIOD_S:
                said[sentence] = now
                warn(sentence)


_VARIABLE = "ZENOH_ROUTER_CHECK_ATTEMPTS"
_NO_ROUTER = (
    "Unable to connect to a Zenoh router. "
    "Have you started a router with `ros2 run rmw_zenoh_cpp rmw_zenohd`?"
)
_GIVEN_UP = (
    "Unable to connect to a Zenoh router after {} attempt(s) (ZENOH_ROUTER_CHECK_ATTEMPTS). Going "
    "on without one: only nodes that multicast or static peers reach are found."
)


def wait_for_router(session: zenoh.Session) -> None:
    """Wait for a router as long as ``ZENOH_ROUTER_CHECK_ATTEMPTS`` says.

    A positive number is that many seconds (rmw_zenoh's attempts are a second apart), 0 means no
    limit, a negative number no check. The session continues without a router, after a warning.
    """
    attempts = _attempts()
    if attempts < 0:
        return
    connected = threading.Event()

    def on_transport(event: zenoh.TransportEvent) -> None:
        if event.kind == SampleKind.PUT and event.transport.whatami == WhatAmI.ROUTER:
            connected.set()

    listener = session.info.declare_transport_events_listener(
        Callback(on_transport, indirect=False), history=True
    )
    try:
        if session.info.routers_zid():
            return
        warn(_NO_ROUTER)
        if not connected.wait(attempts or None):
            warn(_GIVEN_UP.format(attempts))
    finally:
        listener.undeclare()  # type: ignore[no-untyped-call]


def _attempts() -> int:
    text = os.environ.get(_VARIABLE, "").strip()
    if not text:
        return -1
    try:
        return int(text)
    except ValueError:
        warn_once(
            _VARIABLE,
            f"{_VARIABLE} is not an integer, so the session does not wait for a router: {text}",
        )
        return -1


_ENDING = {signal.SIGINT, signal.SIGTERM}
_DAY_S = 86_400.0


def route() -> None:
    """Route until SIGINT or SIGTERM comes; on the main thread.

    Raises:
        WireError: The configuration is wrong, or its address is taken.
    """
    if sys.platform != "win32":
        # Zenoh's threads inherit it, so that none of them takes the signal.
        signal.pthread_sigmask(signal.SIG_BLOCK, _ENDING)
    with explained_log() as output:
        _route(output)


def _route(output: TextIO) -> None:
    configuration = router_configuration()
    try:
        session = zenoh.open(configuration)
    except zenoh.ZError as error:
        failed = WireError(f"cannot start a Zenoh router: {reason_of(error)}")
        raise failed.with_hint(
            "If its port is in use, a router may already be running; for another address, set "
            "ZENOH_CONFIG_OVERRIDE='listen/endpoints=[\"tcp/127.0.0.1:7448\"]'"
        ) from error
    output.write(f"Started Zenoh router with id {session.zid()}\n")
    output.flush()
    warn_of_faults(configuration)
    _wait_for_end()
    session.close()  # type: ignore[no-untyped-call]


def _wait_for_end() -> None:
    if sys.platform == "win32":
        with suppress(KeyboardInterrupt):
            while True:
                time.sleep(_DAY_S)  # which Ctrl-C ends there, unlike a wait for an event
    else:
        signal.sigwait(_ENDING)
