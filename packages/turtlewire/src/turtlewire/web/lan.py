"""Serves a page to other devices of the network: its token, its addresses, its QR code.

The token is part of the path of the page's address, so files, WebSocket and reloads carry it
without a cookie, which other servers of this computer would get as well.
"""

from __future__ import annotations

import contextlib
import socket
import struct
import sys
from collections.abc import Callable, Iterable

_SIOCGIFADDR = 0x8915  # <linux/sockios.h>
#: Lower case without i, l, o, 0 and 1, for typing the address: 79 bits in 16 letters.
_LETTERS = "abcdefghjkmnpqrstuvwxyz23456789"
_TOKEN_LENGTH = 16
#: An address that no computer has (RFC 5737). Connecting a UDP socket to it sends nothing, but
#: chooses the interface of the default route.
_ANYWHERE = ("192.0.2.1", 9)
#: Always black on white, because some readers cannot read light codes on dark.
_QR_COLOURS = "\x1b[38;5;16;48;5;231m"
_RESET = "\x1b[0m"
#: Upper and lower module of a character: light or dark.
_HALVES = {(0, 0): " ", (1, 0): "▀", (0, 1): "▄", (1, 1): "█"}
#: Light modules around the code: two are enough on a screen, and fit 80 x 24.
_QUIET_ZONE = 2


def new_token() -> str:
    """Return a token for one run of a server, which cannot be guessed."""
    import secrets

    return "".join(secrets.choice(_LETTERS) for _ in range(_TOKEN_LENGTH))


def path_below(token: str, path: str) -> str | None:
    """The path behind ``/token``, empty if nothing follows; None if it begins with another word.

    The comparison takes constant time, which reveals nothing about the token.
    """
    import hmac

    word, slash, rest = path[1:].partition("/")
    given = word.encode("utf-8", "surrogateescape")
    return slash + rest if hmac.compare_digest(given, token.encode()) else None


def interface_addresses() -> list[str]:
    """IPv4 addresses of this computer's interfaces, loopback included."""
    if sys.platform != "linux":
        return socket.gethostbyname_ex(socket.gethostname())[2]
    import fcntl

    found = []
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asked:
        for _, name in socket.if_nameindex():
            request = struct.pack("256s", name.encode()[:15])
            try:  # an interface need not have an IPv4 address
                answer = fcntl.ioctl(asked.fileno(), _SIOCGIFADDR, request)
            except OSError:
                continue
            found.append(socket.inet_ntoa(answer[20:24]))
    return found


def lan_addresses() -> list[str]:
    """IPv4 addresses under which others may reach this computer, the likeliest one first.

    That is the address of the default route. The others can belong to a second network, a VPN or
    a container bridge.
    """
    found = []
    probe = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    with probe, contextlib.suppress(OSError):  # there is no default route
        probe.connect(_ANYWHERE)
        found.append(str(probe.getsockname()[0]))
    with contextlib.suppress(OSError):  # this computer's name has no address
        found += interface_addresses()
    return list(dict.fromkeys(address for address in found if not address.startswith("127.")))


def invite(url: str, log: Callable[[str], object]) -> None:
    """Say how another device reaches a page that is served with ``lan=True``.

    Args:
        url: The page's address on this computer.
        log: Takes the lines. The QR code goes to the standard output if that is a terminal.
    """
    best, *others = lan_addresses() or [""]
    if not best:
        log(
            "This computer has no network address but loopback, so no other device reaches the "
            "page. Connect it to a network, and start again to see the address."
        )
        return
    there = url.replace("127.0.0.1", best, 1)
    log(f"On another device of this network: {there}")
    log(
        "Anyone who has this address can use the page, and the connection is not encrypted. In a "
        "network that you do not trust, forward the port with ssh -L instead."
    )
    if others:
        log(
            f"{best} is the address in the default network. If it does not work, try "
            f"{' or '.join(others)} instead."
        )
    if sys.stdout.isatty():
        _show_qr_code(there, log)


def _show_qr_code(url: str, log: Callable[[str], object]) -> None:
    import shutil

    try:
        import segno
    except ModuleNotFoundError:
        log("The address is shown as a QR code here after `pip install segno`.")
        return
    lines = qr_code(segno.make(url, error="l", micro=False).matrix)
    if len(lines[0]) > shutil.get_terminal_size().columns:
        log("A wider terminal shows the address as a QR code.")
        return
    text = "".join(f"{_QR_COLOURS}{line}{_RESET}\n" for line in lines)
    try:
        text.encode(sys.stdout.encoding)
    except UnicodeEncodeError:
        log("A terminal with UTF-8 shows the address as a QR code.")
        return
    sys.stdout.write(text)
    sys.stdout.flush()


def qr_code(modules: Iterable[Iterable[int]]) -> list[str]:
    """Lines of half blocks, two rows of modules (1: dark) each, with a light border around."""
    inner = [[0] * _QUIET_ZONE + [int(bit) for bit in row] + [0] * _QUIET_ZONE for row in modules]
    light = [0] * len(inner[0])
    rows = [light] * _QUIET_ZONE + inner + [light] * _QUIET_ZONE
    if len(rows) % 2:
        rows.append(light)
    return [
        "".join(_HALVES[pair] for pair in zip(upper, lower, strict=True))
        for upper, lower in zip(rows[::2], rows[1::2], strict=True)
    ]
