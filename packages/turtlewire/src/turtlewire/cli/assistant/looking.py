"""The tools that only read: topics, services, messages, transforms, pictures."""

from __future__ import annotations

import asyncio
import json
import math
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

import anyio

from turtlewire.cli.assistant.permissions import RefusedCallError, bounded_json, seconds_within
from turtlewire.cli.assistant.plots import Series
from turtlewire.cli.frame_picture import take_picture
from turtlewire.errors import TransformException
from turtlewire.msg.json_messages import json_value
from turtlewire.tf.buffer import Buffer, Transform
from turtlewire.tf.listener import NOTHING_RECEIVED, TransformListener
from turtlewire.wake_up import LoopWakeUp
from turtlewire.wording import counted

if TYPE_CHECKING:
    from turtlewire.cli.assistant.network import Network
    from turtlewire.cli.assistant.permissions import Permissions

_LONGEST_S = 30.0


class Looking:
    """The tools; their docstrings are what an assistant reads.

    Args:
        network: What they look at. Each subscribes only while it is called.
        permissions: Shown in the lists, so that an assistant knows what it may use.
    """

    def __init__(self, network: Network, permissions: Permissions) -> None:
        self._network = network
        self._permissions = permissions

    async def list_topics(self, containing: str = "") -> str:
        """List the topics with their types, and the numbers of their publishers and subscriptions.

        Args:
            containing: Only topics whose name or type contains this text.
        """
        graph = self._network.graph
        return bounded_json(
            [
                {
                    "topic": name,
                    "types": types,
                    "publishers": len(graph.endpoints_of(name, "publisher")),
                    "subscriptions": len(graph.endpoints_of(name, "subscription")),
                    "may_publish": self._permissions.allow(name),
                }
                for name, types in sorted((await self._network.topics()).items())
                if containing in name or any(containing in each for each in types)
            ]
        )

    async def list_services(self, containing: str = "") -> str:
        """List the services with their types.

        Args:
            containing: Only services whose name or type contains this text.
        """
        return bounded_json(
            [
                {"service": name, "types": types, "may_call": self._permissions.allow(name)}
                for name, types in sorted((await self._network.services()).items())
                if containing in name or any(containing in each for each in types)
            ]
        )

    async def echo(self, topic: str, timeout_s: float = 5.0) -> str:
        """Wait for one message of a topic, and return it as JSON.

        Args:
            topic: Such as /turtle1/pose.
            timeout_s: How long to wait for it, at most 30.
        """
        limit_s = seconds_within(timeout_s, "timeout_s", _LONGEST_S)
        name, type_name = await self._network.type_of_topic(topic)
        with (
            self._network.connection.subscribe(name) as subscription,
            anyio.move_on_after(limit_s),
        ):
            async for message in subscription:
                return bounded_json(
                    {"topic": name, "type": type_name, "message": json_value(message)}
                )
        raise self._silent(name, limit_s)

    async def list_frames(self, listen_s: float = 1.0) -> str:
        """List the TF frames: parent, age of the newest transform [s], rate [Hz], publishers.

        Args:
            listen_s: How long to listen before, at most 30.
        """
        limit_s = seconds_within(listen_s, "listen_s", _LONGEST_S)
        with self._transforms() as (buffer, listener):
            await anyio.sleep(limit_s)
            picture = take_picture(buffer, time.time_ns(), None, listener.departed_frames())
        if not picture.rows:
            raise RefusedCallError(f"{picture.missing} Listened for {limit_s:g} s (listen_s).")
        return bounded_json(json.loads(picture.as_json()))

    async def lookup_transform(
        self, target_frame: str, source_frame: str, timeout_s: float = 5.0
    ) -> str:
        """Return where the source frame is, seen from the target frame: metres, and a quaternion.

        Args:
            target_frame: The frame in which the answer is expressed, such as world.
            source_frame: The frame whose pose is asked for, such as turtle1.
            timeout_s: How long to wait for the transform, at most 30.
        """
        limit_s = seconds_within(timeout_s, "timeout_s", _LONGEST_S)
        with self._transforms() as (buffer, _):
            found = await _lookup(buffer, target_frame, source_frame, limit_s)
        roll, pitch, yaw = (math.degrees(angle) for angle in found.euler)
        return bounded_json(
            {
                "target_frame": target_frame,
                "source_frame": source_frame,
                "stamp_ns": found.stamp_ns,
                "translation": dict(zip("xyz", found.translation, strict=True)),
                "rotation": dict(zip("xyzw", found.rotation, strict=True)),
                "degrees": {"roll": roll, "pitch": pitch, "yaw": yaw},
            }
        )

    async def record(self, topic: str, field: str, seconds: float) -> tuple[str, bytes]:
        """Return the summary of a numeric field over some seconds, and its curve as PNG."""
        limit_s = seconds_within(seconds, "seconds", _LONGEST_S)
        name, _ = await self._network.type_of_topic(topic)
        series = Series(f"{name} {field}", field)
        with (
            self._network.connection.subscribe(name) as subscription,
            anyio.move_on_after(limit_s),
        ):
            await series.collect(subscription)
        if not len(series):
            raise self._silent(name, limit_s)
        summary: dict[str, Any] = {"topic": name, "field": field, "seconds": limit_s}
        summary |= series.summary() | {"dropped": subscription.dropped}
        return bounded_json(summary), series.png(limit_s)

    @contextmanager
    def _transforms(self) -> Iterator[tuple[Buffer, TransformListener]]:
        buffer = Buffer()
        buffer._hint_if_empty = NOTHING_RECEIVED
        network = self._network
        with TransformListener(buffer, network.node, context=network.context) as listener:
            yield buffer, listener

    def _silent(self, topic: str, limit_s: float) -> RefusedCallError:
        publishers = len(self._network.graph.endpoints_of(topic, "publisher"))
        return RefusedCallError(
            f"No message on {topic} within {limit_s:g} s; it has "
            + (counted(publishers, "silent publisher") if publishers else "no publisher")
        )


async def _lookup(buffer: Buffer, target: str, source: str, limit_s: float) -> Transform:
    """Look up the latest transform again after each change of the buffer.

    A lookup with a timeout would hold a thread that a cancelled call cannot end.
    """
    changed = LoopWakeUp(asyncio.get_running_loop())
    stop = buffer.on_change(changed.set)
    try:
        with anyio.move_on_after(limit_s):
            while True:
                with suppress(TransformException):
                    return buffer.lookup_transform(target, source)
                await changed.wait()
    finally:
        stop()
    return buffer.lookup_transform(target, source)
