"""Rewords the messages of a router's library about rejected peers.

Zenoh logs to standard output, which this module replaces by a pipe; the reworded sentences go to
standard error. With ``RUST_LOG``, the log is left as it is.
"""

from __future__ import annotations

import os
import re
import sys
import threading
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING, TextIO

import zenoh

from turtlewire.program import open_output
from turtlewire.wire.report import warn

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["explain", "explained_log"]

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
