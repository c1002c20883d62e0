"""Shows transforms, joint states, images and point clouds in Rerun: of a bag, or live."""

from __future__ import annotations

import argparse
import asyncio
import signal
import sys
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

import rerun as rr
from entities import Entities

import turtlewire
from turtlewire.bag import open_bag
from turtlewire.errors import TurtlewireError
from turtlewire.wire.qos import Durability, QoS

if TYPE_CHECKING:
    from turtlewire.net import Subscription

TF = "tf2_msgs/msg/TFMessage"
MANY = QoS(depth=1000)
LATCHED = QoS(depth=1000, durability=Durability.TRANSIENT_LOCAL)


def parsed(words: list[str] | None) -> argparse.Namespace:
    """Return the arguments of the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    add = parser.add_argument
    add("bag", nargs="?", metavar="BAG", help="a bag; without it, the nodes that run now")
    add("-o", "--output", metavar="FILE.rrd", help="write a file; without it, the viewer opens")
    add("--topic", action="append", default=[], help="live: another topic to log, next to TF")
    add("--seconds", type=float, metavar="S", help="live: end after this time")
    arguments = parser.parse_args(words)
    if arguments.bag and (arguments.topic or arguments.seconds is not None):
        parser.error("--topic and --seconds are for running nodes, not for a bag")
    return arguments


async def follow(subscription: Subscription, entities: Entities) -> None:
    """Log the messages of a topic as they arrive."""
    async for message in subscription:
        entities.log_message(subscription.topic, message)


async def log_live(entities: Entities, topics: list[str], seconds: float | None) -> None:
    """Log the transforms of the running nodes, and other topics, until Ctrl-C."""
    ended = asyncio.Event()
    with suppress(NotImplementedError):  # Windows
        asyncio.get_running_loop().add_signal_handler(signal.SIGINT, ended.set)
    with turtlewire.connect("rerun_log") as net:
        followed = [net.subscribe("/tf", TF, qos=MANY)]
        followed += [net.subscribe("/tf_static", TF, qos=LATCHED)]
        followed += [net.subscribe(name) for name in topics]
        tasks = [asyncio.create_task(follow(each, entities)) for each in followed]
        waiting = asyncio.create_task(ended.wait())
        await asyncio.wait([*tasks, waiting], timeout=seconds, return_when=asyncio.FIRST_COMPLETED)
        for task in (*tasks, waiting):
            task.cancel()
        found = await asyncio.gather(*tasks, return_exceptions=True)
    for error in found:
        if isinstance(error, Exception):
            raise error


def start(name: str, output: str | None) -> None:
    """Open a recording: a file, or the viewer."""
    rr.init(name)
    if output:
        rr.save(output)
    else:
        rr.spawn()


def log(arguments: argparse.Namespace) -> None:
    """Log a bag, or the running nodes."""
    if arguments.bag:
        with open_bag(arguments.bag) as bag:  # a wrong path must not empty the file
            start(Path(arguments.bag).resolve().name, arguments.output)
            Entities().log_bag(bag)
    else:
        start("live", arguments.output)
        asyncio.run(log_live(Entities(), arguments.topic, arguments.seconds))


def main(words: list[str] | None = None) -> int:
    """Log what the command line names."""
    arguments = parsed(words)
    try:
        log(arguments)
    except (OSError, RuntimeError, TurtlewireError, ValueError) as error:  # Rerun's: RuntimeError
        print(error, file=sys.stderr)
        if hint := getattr(error, "hint", ""):
            print(hint, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    finally:
        rr.disconnect()
    return 0


if __name__ == "__main__":
    sys.exit(main())
