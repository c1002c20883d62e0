"""A server of the view's page that says exactly what a test wants it to say."""

from __future__ import annotations

import json
import math
import struct
import threading
from collections.abc import Callable, Sequence
from importlib.resources import files
from typing import Any

import numpy as np

from turtlewire.web import Server
from turtlewire.web.packets import encode_packet


def decode_packet(data):
    """The header, with each array in place of its description; or what a text says."""
    if isinstance(data, str):
        return json.loads(data)
    (length,) = struct.unpack_from("<I", data)
    header = json.loads(data[4 : 4 + length])
    start = 4 + length
    for name, (kind, shape) in header["arrays"].items():
        assert start % 8 == 0
        count = int(np.prod(shape))
        header["arrays"][name] = np.frombuffer(data, "<" + kind, count, start).reshape(shape)
        start += -(-header["arrays"][name].nbytes // 8) * 8
    assert start == len(data)
    return header


IDENTITY = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


def pose(x: float, y: float, z: float = 0.0, *, yaw: float = 0.0) -> tuple[float, ...]:
    """A pose of seven numbers."""
    return (x, y, z, 0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))


class FakeView:
    """One page's server: packets go out as they are told, commands are kept."""

    def __init__(self, kind: str = "live", name: str = "domain 7") -> None:
        self.commands: list[dict[str, Any]] = []
        self._told = [encode_packet({"type": "hello", "source": {"kind": kind, "name": name}})]
        self._version = 0
        self._changed = threading.Condition()
        self._sessions: list[FakeSession] = []
        self._server = Server(files("turtlewire_view") / "page", self._connect)
        self.url = self._server.url

    def tell(self, header: dict[str, Any], arrays: dict[str, np.ndarray] | None = None) -> None:
        """Send a packet, and again to pages that come later."""
        packet = encode_packet(header, arrays)
        with self._changed:
            self._told.append(packet)
            for session in self._sessions:
                session.queue.append(packet)
        self._server.notify()

    def names(self, parents: dict[str, str], *, fixed: str = "") -> None:
        """Frames and their parents; roots are those that have none (``""``)."""
        names = list(parents)
        roots = [name for name, parent in parents.items() if not parent]
        self._version += 1
        self.tell(
            {
                "type": "names",
                "version": self._version,
                "names": names,
                "parents": [names.index(parent) if parent else -1 for parent in parents.values()],
                "trees": [roots.index(root_of(name, parents)) for name in names],
                "roots": roots,
                "loops": [],
                "fixed": fixed or roots[0],
                "chosen": fixed,
            }
        )

    def frames(
        self,
        poses: Sequence[Sequence[float]],
        *,
        stamps: Sequence[float] | None = None,
        known: Sequence[int] | None = None,
        origin: Sequence[float] = (0.0, 0.0, 0.0),
    ) -> None:
        """Poses in the fixed frame; without stamps all frames are static."""
        count = len(poses)
        arrays = {
            "poses": np.array(poses, np.float32).reshape(count, 7),
            "stamps": np.array([0.0] * count if stamps is None else stamps, np.float64),
            "known": np.array([1] * count if known is None else known, np.uint8),
        }
        head = {"type": "frames", "version": self._version, "stamp": 1000.0}
        self.tell({**head, "origin": list(origin)}, arrays)

    def wait_for(self, fits: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
        """The first command of a page that fits, perhaps one that is still to come."""
        with self._changed:
            assert self._changed.wait_for(lambda: any(map(fits, self.commands)), timeout=60), (
                f"none of {self.commands} fits"
            )
            return next(command for command in self.commands if fits(command))

    def close(self) -> None:
        self._server.close()

    def _connect(self) -> FakeSession:
        session = FakeSession(self._take, list(self._told))
        self._sessions.append(session)
        return session

    def _take(self, command: dict[str, Any]) -> None:
        with self._changed:
            self.commands.append(command)
            self._changed.notify_all()


class FakeSession:
    """A page's connection."""

    def __init__(self, take: Callable[[dict[str, Any]], None], queue: list[bytes]) -> None:
        self._take = take
        self.queue = queue

    def outgoing(self) -> list[str | bytes]:
        sent, self.queue[:] = list(self.queue), []
        return sent

    def receive(self, message: str | bytes) -> None:
        import json

        self._take(json.loads(message))

    def closed(self) -> None:
        pass


def root_of(name: str, parents: dict[str, str]) -> str:
    while parents[name]:
        name = parents[name]
    return name
