"""What ten listening processes could save if one of them stored the transforms for all.

A store in shared memory can take no more from a process than what storing costs, as long as its
subscription stays in the graph; and no more than the whole subscription, if it does not.
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import time
from collections.abc import Iterator

from benchmarks import tf_listener
from benchmarks.figures import Figure, Row, on_loopback
from benchmarks.growth import cpu_each_second

TITLE = "Ten processes that hear 100 messages of 20 transforms a second: CPU of all in a second"
PROCESSES = 10
ENVIRONMENT = on_loopback(105)
WAYS = {
    "listener": "each listens and stores",
    "receiver": "one stores, nine receive only: the graph stays as in ROS 2",
    "node": "one stores, nine are nodes without subscriptions to transforms",
}


def rows() -> Iterator[Row]:
    figures = {way: measured(way) for way in WAYS}
    rivals = {WAYS[way]: figures[way] for way in ("receiver", "node")}
    yield Row(WAYS["listener"], figures["listener"], rivals, "a gain of 3 for a shared store")


def measured(way: str) -> Figure:
    """Return the CPU of one listener and nine processes of a kind."""
    ways = ["listener"] + [way] * (PROCESSES - 1)
    with contextlib.ExitStack() as stack:
        _running(stack, tf_listener.__name__, "publish", "20", "100")
        processes = [_running(stack, __name__, each) for each in ways]
        for each in processes:
            assert each.stdout is not None
            assert each.stdout.readline() == b"ready\n"
        return Figure.of(cpu_each_second([each.pid for each in processes]))


def _running(stack: contextlib.ExitStack, *arguments: str) -> subprocess.Popen[bytes]:
    process = stack.enter_context(
        subprocess.Popen(
            [sys.executable, "-m", *arguments], env=ENVIRONMENT, stdout=subprocess.PIPE
        )
    )
    stack.callback(process.terminate)
    return process


def take_part(way: str) -> None:
    """Be one of the processes."""
    from turtlewire import Buffer, msg, wire
    from turtlewire.tf.listener import (
        QOS,
        STATIC_QOS,
        STATIC_TOPIC,
        TOPIC,
        TYPE_NAME,
        TransformListener,
    )
    from turtlewire.wire.base import TypeId

    context = wire.open_context()
    node = context.create_node(f"{way}_{os.getpid()}")
    if way == "listener":
        buffer = Buffer()
        TransformListener(buffer, node, context=context)
        buffer.lookup_transform("world", "frame0", None, timeout_ns=60_000_000_000)
    elif way == "receiver":
        type_id = TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME))
        for topic, qos in ((TOPIC, QOS), (STATIC_TOPIC, STATIC_QOS)):
            node.create_subscription(topic, type_id, qos)
        context.graph.wait_for(lambda: bool(context.graph.endpoints_of(TOPIC, "publisher")))
    print("ready", flush=True)
    time.sleep(1e6)


if __name__ == "__main__":
    take_part(sys.argv[1])
