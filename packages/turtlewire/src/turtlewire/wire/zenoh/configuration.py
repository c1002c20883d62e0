"""The configuration of a session or a router: rmw_zenoh's, and the variables that change it.

Sessions differ from rmw_zenoh's in one point: they look for each other by multicast on the loopback
interface (with ``ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET``, on all interfaces), so that no router is
needed. A router at port 7447 is used as well, as there.

Where shared memory is enabled, large messages are written into it. Zenoh moves what it is given
there as well, but first into memory of its own: an image would be copied once more, into fresh
pages each time.
"""

from __future__ import annotations

import json
import os
import sys
import threading
from collections.abc import Callable
from typing import Any

import zenoh
from zenoh import shm

from turtlewire.errors import WireError
from turtlewire.wire import environment
from turtlewire.wire.environment import Range
from turtlewire.wire.report import warn_once

from .library import reason_of

ROUTER_PORT = 7447

_LOOPBACK = {"darwin": "lo0", "linux": "lo"}
_PEERS_AND_ROUTERS = ["router", "peer"]
_GOSSIP = {
    "enabled": True,
    "target": {"router": _PEERS_AND_ROUTERS, "peer": ["router"]},
}
#: The variables of rmw_zenoh that size shared memory, with their keys.
_SHARED_MEMORY = {
    "ZENOH_SHM_ALLOC_SIZE": "pool_size",
    "ZENOH_SHM_MESSAGE_SIZE_THRESHOLD": "message_size_threshold",
}
#: Of sessions and routers, as rmw_zenoh's.
_SHARED_MEMORY_DEFAULTS = {
    "enabled": False,
    "mode": "lazy",
    "transport_optimization": {
        "enabled": True,
        "pool_size": 48 * 1024 * 1024,
        "message_size_threshold": 512,
    },
}
_UNICAST = {
    "open_timeout": 60_000,
    "accept_timeout": 60_000,
    "accept_pending": 10_000,
    "max_sessions": 10_000,
}


def session_configuration() -> zenoh.Config:
    """Return the configuration of a context's session.

    Raises:
        WireError: ``ZENOH_SESSION_CONFIG_URI`` names no configuration,
            ``ZENOH_CONFIG_OVERRIDE`` has more than one line, or a static peer is not an address.
    """
    return _configuration("ZENOH_SESSION_CONFIG_URI", _session)


def stays_on_loopback(configuration: zenoh.Config) -> bool:
    """Return True if a session looks for others on the loopback interface alone."""
    interface = json.loads(configuration.get_json("scouting/multicast/interface"))
    return interface is not None and interface == _LOOPBACK.get(sys.platform)


def router_configuration() -> zenoh.Config:
    """Return the configuration of ``rmw_zenohd``.

    Raises:
        WireError: ``ZENOH_ROUTER_CONFIG_URI`` names no configuration, or
            ``ZENOH_CONFIG_OVERRIDE`` has more than one line.
    """
    return _configuration("ZENOH_ROUTER_CONFIG_URI", _router)


def _configuration(variable: str, default: Callable[[], dict[str, Any]]) -> zenoh.Config:
    path = os.environ.get(variable, "").strip()
    if not path:
        configuration: zenoh.Config = zenoh.Config.from_json5(json.dumps(default()))
    else:
        try:
            configuration = zenoh.Config.from_file(path)
        except zenoh.ZError as error:
            failed = WireError(f"Invalid configuration file {path}")
            raise failed.with_hint(
                f"{variable} names it; Zenoh says: {reason_of(error)}"
            ) from error
    _override(configuration)
    _size_shared_memory(configuration)
    return configuration


def _override(configuration: zenoh.Config) -> None:
    """Apply ``ZENOH_CONFIG_OVERRIDE``: ``key/path=value;key2=value2``, values in JSON5.

    Raises:
        WireError: The value has a line break. rmw_zenoh_cpp cuts a value there and continues, which
            would turn off access control.
    """
    text = os.environ.get("ZENOH_CONFIG_OVERRIDE", "").strip()
    if len(text.splitlines()) > 1:
        failed = WireError("ZENOH_CONFIG_OVERRIDE has more than one line")
        raise failed.with_hint(
            "rmw_zenoh_cpp ignores what follows a line break: write it in one line, or end each "
            "line with a backslash inside the double quotes of bash."
        )
    for pair in text.split(";"):
        if not pair.strip():
            continue
        key, _, value = (part.strip() for part in pair.partition("="))
        try:
            configuration.insert_json5(key, value)
        except zenoh.ZError:
            warn_once(
                f"ZENOH_CONFIG_OVERRIDE {pair}",
                f"Ignore the invalid configuration key-value pair: ({key}, {value})",
            )


def _size_shared_memory(configuration: zenoh.Config) -> None:
    """Apply ``ZENOH_SHM_ALLOC_SIZE`` and ``ZENOH_SHM_MESSAGE_SIZE_THRESHOLD``.

    As in rmw_zenoh, they count only where ``transport/shared_memory/enabled`` is true.
    """
    if configuration.get_json("transport/shared_memory/enabled") != "true":
        return
    for variable, key in _SHARED_MEMORY.items():
        text = os.environ.get(variable, "").strip()
        if not text:
            continue
        size = int(text) if text.isdecimal() else 0
        is_threshold = key == "message_size_threshold"
        if size == 0 or (is_threshold and size & (size - 1)):
            wanted = "a power of 2" if is_threshold else "a positive number of bytes"
            warn_once(variable, f"{variable} must be {wanted}, so it is ignored: {text}")
            continue
        path = f"transport/shared_memory/transport_optimization/{key}"
        configuration.insert_json5(path, str(size))


def _endpoint(peer: str) -> str:
    """Return the locator of a static peer."""
    if peer.startswith("["):  # an IPv6 address, which Zenoh checks
        return f"tcp/{peer}" if "]:" in peer else f"tcp/{peer}:{ROUTER_PORT}"
    host, port = environment.split_peer(peer)
    return f"tcp/{host}:{port or ROUTER_PORT}"


def _session() -> dict[str, Any]:
    discovery = environment.discovery()
    on_loopback = discovery.range is Range.LOCALHOST
    alone = discovery.range is Range.OFF
    loopback = _LOOPBACK.get(sys.platform)
    # With SUBNET, the user has asked for peers on other hosts.
    address = "127.0.0.1" if on_loopback or alone else "0.0.0.0"  # noqa: S104
    routers = [] if alone else [f"tcp/127.0.0.1:{ROUTER_PORT}"]
    peers = [_endpoint(peer) for peer in discovery.asked_peers]
    to_peers = {"router": [], "peer": _PEERS_AND_ROUTERS}
    return {
        "mode": "peer",
        "connect": {
            "timeout_ms": {"router": -1, "peer": -1, "client": 0},
            "endpoints": routers + peers,
            "exit_on_failure": {"router": False, "peer": False, "client": True},
            "retry": {
                "period_init_ms": 1000,
                "period_max_ms": 4000,
                "period_increase_factor": 2,
            },
        },
        "listen": {"timeout_ms": 0, "endpoints": [f"tcp/{address}:0"]},
        "scouting": {
            # Nothing is waited for here: the graph says when it is complete.
            "delay": 0,
            "multicast": {
                "enabled": not alone,
                "interface": loopback if on_loopback and loopback else "auto",
                "autoconnect": to_peers,
                "listen": True,
            },
            "gossip": {
                **_GOSSIP,
                "autoconnect": to_peers,
                "autoconnect_strategy": {"peer": {"to_router": "always", "to_peer": "greater-zid"}},
            },
        },
        "timestamping": {"enabled": True},
        "queries_default_timeout": 600_000,
        "routing": {"interests": {"timeout": 10_000}},
        "transport": {
            "unicast": _UNICAST,
            "link": _link(wait_before_close_us=60_000_000),
            "shared_memory": _SHARED_MEMORY_DEFAULTS,
        },
        "adminspace": {"enabled": True},
    }


def _router() -> dict[str, Any]:
    return {
        "mode": "router",
        "listen": {"endpoints": [f"tcp/127.0.0.1:{ROUTER_PORT}"]},
        "scouting": {"multicast": {"enabled": False}, "gossip": _GOSSIP},
        "timestamping": {"enabled": True},
        "routing": {
            "router": {"peers_failover_brokering": False},
            "interests": {"timeout": 10_000},
        },
        "transport": {
            "unicast": _UNICAST,
            "link": _link(wait_before_close_us=5_000_000),
            "shared_memory": _SHARED_MEMORY_DEFAULTS,
        },
        "adminspace": {"enabled": True},
    }


def _link(*, wait_before_close_us: int) -> dict[str, Any]:
    """Return the settings of all links: a peer that is silent for 60 s is gone."""
    block = {"wait_before_close": wait_before_close_us}
    return {
        "tx": {
            "lease": 60_000,
            "keep_alive": 2,
            "queue": {"congestion_control": {"block": block}},
        }
    }


_KEY = "transport/shared_memory"
#: Smaller messages take longer to place than to copy.
_LARGE = 64 * 1024


class SharedMemory:
    """The pool into which a context's publishers write large messages. Thread-safe.

    The pool has the size of the one that Zenoh makes for itself, and is made for the first large
    message.

    Args:
        configuration: Says whether there is shared memory, and how much.
    """

    def __init__(self, configuration: zenoh.Config) -> None:
        settings = json.loads(configuration.get_json(_KEY))
        optimization = settings["transport_optimization"]
        self._lock = threading.RLock()
        self._provider: shm.ShmProvider | None = None
        self._size: int = optimization["pool_size"]
        self._is_usable: bool = settings["enabled"] and optimization["enabled"]
        self._threshold: int = max(_LARGE, optimization["message_size_threshold"])

    def placed(self, cdr: bytes) -> bytes | shm.ZShmMut:
        """Return a copy in shared memory, or the message itself if the pool is full or missing."""
        if not self._is_usable or len(cdr) < self._threshold:
            return cdr
        provider = self._provider or self._open()
        if provider is None:
            return cdr
        try:
            # Does not wait: a subscriber that has stopped would hold up the publisher forever.
            buffer = provider.alloc(len(cdr), shm.GarbageCollect())
        except zenoh.ZError:
            return cdr
        buffer[: len(cdr)] = cdr
        return buffer

    def _open(self) -> shm.ShmProvider | None:
        """Make the pool; None if that fails or the context is closed."""
        with self._lock:
            if self._provider is None and self._is_usable:
                try:
                    self._provider = shm.ShmProvider.default_backend(self._size)
                except zenoh.ZError as error:
                    self._is_usable = False
                    warn_once("shared memory", f"messages are copied: {reason_of(error)}")
            return self._provider

    def close(self) -> None:
        """Free the pool, once no publisher uses it any more."""
        with self._lock:
            self._is_usable = False
            self._provider = None
