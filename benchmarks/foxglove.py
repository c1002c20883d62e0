"""`turtlewire foxglove`: CPU of the server for each message, and how soon latched messages come.

The rival is the minimum for Python: a process whose subscription calls an empty function.
"""

from __future__ import annotations

import asyncio
import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from benchmarks.figures import Figure, Row
from turtlewire.msg import get_message, serialize, type_hash
from turtlewire.testing import isolated_domain
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import Durability, QoS

if TYPE_CHECKING:
    from turtlewire.wire.base import Context, Publisher

TITLE = "Foxglove server: CPU of its process for each message of 100 bytes"
STRING = "std_msgs/msg/String"
ROUNDS, SECONDS, KEEPERS = 3, 3, 5


def rows() -> Iterator[Row]:
    with isolated_domain():
        for clients, rate in ((1, 1000), (20, 100)):
            alone = [empty_subscription(rate) for _ in range(ROUNDS)]
            ours = [served(clients, rate) for _ in range(ROUNDS)]
            yield Row(f"{clients} clients, {rate} Hz", Figure.of(ours), {"empty": Figure.of(alone)})
        joined = [latched(20) for _ in range(ROUNDS)]
        yield Row(f"20 clients join: all have {KEEPERS} latched messages after", Figure.of(joined))


def type_id() -> TypeId:
    return TypeId(STRING, type_hash(STRING))


@contextmanager
def domain() -> Iterator[Context]:
    context = open_context()
    try:
        yield context
    finally:
        context.close()


@contextmanager
def program(*words: str) -> Iterator[subprocess.Popen[str]]:
    """A process that says a line when it is ready."""
    with subprocess.Popen(
        words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as process:
        try:
            yield process
        finally:
            process.kill()


@contextmanager
def foxglove() -> Iterator[tuple[str, int]]:
    """A server: its address and its process."""
    command = str(Path(sys.executable).parent / "turtlewire")
    with program(command, "foxglove", "--port", "0") as process:
        assert process.stdout is not None
        yield next(word for word in process.stdout.readline().split() if "://" in word), process.pid


def cpu_ns(pid: int) -> float:
    """CPU time of a process so far; its clock ticks a hundred times a second."""
    fields = Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK") * 1e9


def send(publisher: Publisher, pid: int, rate: int) -> float:
    """Publish for some seconds; CPU of a process for each message."""
    message = serialize(get_message(STRING)(data=100 * "x"))
    time.sleep(0.5)  # the other side has to know the publisher, too
    before, begin = cpu_ns(pid), time.monotonic()
    for number in range(1, rate * SECONDS + 1):
        publisher.publish(message)
        time.sleep(max(0.0, begin + number / rate - time.monotonic()))
    time.sleep(0.5)
    return (cpu_ns(pid) - before) / (rate * SECONDS)


def empty_subscription(rate: int) -> float:
    with domain() as context, program(sys.executable, "-m", __name__) as process:
        publisher = context.create_node("talker").create_publisher(
            "/bench", type_id(), QoS(depth=1000)
        )
        context.graph.wait_for(lambda: publisher.subscription_count() > 0, 10**10)
        return send(publisher, process.pid, rate)


def served(clients: int, rate: int) -> float:
    with domain() as context, foxglove() as (url, pid):
        publisher = context.create_node("talker").create_publisher(
            "/bench", type_id(), QoS(depth=1000)
        )
        # A busy machine may lose some.
        with joined(url, clients, ["/bench"], rate * SECONDS * 9 // 10):
            context.graph.wait_for(lambda: publisher.subscription_count() > 0, 10**10)
            return send(publisher, pid, rate)


def latched(clients: int) -> float:
    """Nanoseconds from the first connection until all clients have all latched messages."""
    qos = QoS(durability=Durability.TRANSIENT_LOCAL)
    with domain() as context, foxglove() as (url, _):
        for number in range(KEEPERS):
            node = context.create_node(f"keeper_{number}")
            publisher = node.create_publisher("/latched", type_id(), qos)
            publisher.publish(serialize(get_message(STRING)(data=str(number))))
        with joined(url, 1, ["/latched"], KEEPERS):  # the server knows the topic after that
            pass
        begin = time.monotonic_ns()
        with joined(url, clients, ["/latched"], KEEPERS):
            pass
        return float(time.monotonic_ns() - begin)


@contextmanager
def joined(url: str, clients: int, topics: list[str], messages: int) -> Iterator[None]:
    """Clients that subscribe; the end of the block waits until each has its messages."""
    subscribed = threading.Barrier(2)

    async def client(ready: asyncio.Event) -> None:
        from websockets.asyncio.client import connect

        count = 0
        async with connect(url, subprotocols=["foxglove.sdk.v1"], compression=None) as server:
            async for frame in server:
                if isinstance(frame, bytes):
                    count += 1
                    if count == messages:
                        return
                    continue
                for channel in json.loads(frame).get("channels", []):
                    if channel["topic"] in topics:
                        wanted = [{"id": 1, "channelId": channel["id"]}]
                        await server.send(json.dumps({"op": "subscribe", "subscriptions": wanted}))
                        ready.set()

    async def all_clients() -> None:
        events = [asyncio.Event() for _ in range(clients)]
        tasks = [asyncio.create_task(client(event)) for event in events]
        for event in events:
            await event.wait()
        await asyncio.to_thread(subscribed.wait)
        await asyncio.wait_for(asyncio.gather(*tasks), 60)

    thread = threading.Thread(target=asyncio.run, args=(all_clients(),))
    thread.start()
    subscribed.wait()
    try:
        yield
    finally:
        thread.join()


if __name__ == "__main__":
    with domain() as here:
        here.create_node("listener").create_subscription(
            "/bench", type_id(), QoS(), lambda _cdr, _info: None
        )
        threading.Event().wait()
