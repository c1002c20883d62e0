"""The network interfaces of this computer."""

from __future__ import annotations

import socket
import struct
import sys
from pathlib import Path
from typing import ClassVar

from ros2doctor.api.reporting import DoctorCheck, DoctorReport, Report, Result, result_of

_OF_INTERFACES = Path("/sys/class/net")
#: The request of Linux for an interface's IPv4 address, from `ioctls.h`.
_SIOCGIFADDR = 0x8915


class InterfaceFlags:
    """The flags of a network interface, for example ``4163<UP,BROADCAST,RUNNING,MULTICAST>``.

    Known on Linux; empty elsewhere.

    Args:
        interface_name: Its name, for example ``eth0``.
    """

    #: Numbers of the flags, from Linux's `if.h`.
    POSIX_NET_FLAGS: ClassVar[tuple[tuple[str, int], ...]] = (
        ("UP", 1 << 0),
        ("BROADCAST", 1 << 1),
        ("LOOPBACK", 1 << 3),
        ("POINTOPOINT", 1 << 4),
        ("RUNNING", 1 << 6),
        ("NOARP", 1 << 7),
        ("PROMISC", 1 << 8),
        ("MULTICAST", 1 << 12),
    )

    def __init__(self, interface_name: str) -> None:
        self.flags: set[str] = set()
        self._number = 0
        self.get(interface_name)

    def get(self, interface_name: str) -> None:
        """Read the flags of an interface."""
        try:
            text = (_OF_INTERFACES / interface_name / "flags").read_text(encoding="ascii")
        except OSError:
            return
        self._number = int(text, 16)
        self.flags = {name for name, bit in self.POSIX_NET_FLAGS if self._number & bit}

    def __str__(self) -> str:
        if not self._number:
            return ""
        names = [name for name, bit in self.POSIX_NET_FLAGS if self._number & bit]
        return f"{self._number}<{','.join(names)}>"


class NetworkCheck(DoctorCheck):
    """Checks that this computer finds others, if it is to look for them."""

    def category(self) -> str:
        return "network"

    def check(self) -> Result:
        from turtlewire.doctor.setup_findings import network_findings

        return result_of(network_findings())


class NetworkReport(DoctorReport):
    """Reports the interfaces, their IPv4 addresses, flags and largest packets."""

    def category(self) -> str:
        return "network"

    def report(self) -> Report:
        report = Report("NETWORK CONFIGURATION")
        for _, name in socket.if_nameindex():
            report.add_to_report("device", name)
            for label, value in (
                ("inet", _address(name)),
                ("flags", str(InterfaceFlags(name))),
                ("mtu", _mtu(name)),
            ):
                if value:
                    report.add_to_report(label, value)
        return report


def _address(interface: str) -> str:
    """Return the IPv4 address; empty without one, and on other systems than Linux."""
    if sys.platform == "win32":
        return ""
    import fcntl

    request = struct.pack("256s", interface.encode()[:15])
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asker:
        try:
            answer = fcntl.ioctl(asker.fileno(), _SIOCGIFADDR, request)
        except OSError:
            return ""
    return socket.inet_ntoa(answer[20:24])


def _mtu(interface: str) -> str:
    try:
        return (_OF_INTERFACES / interface / "mtu").read_text(encoding="ascii").strip()
    except OSError:
        return ""
