"""The processes of scripts/soak: residents that keep running, and visitors that start and end.

`python tools/soak_actors.py ACTOR [ARGUMENT]`; a visitor's argument is its number.
"""

from __future__ import annotations

import asyncio
import contextlib
import sys
import time
import urllib.request
from typing import Any

FRAMES = 20
RATE_HZ = 1000
BROADCASTERS = ("alpha", "beta")
CACHE_S = 1  # of the buffers: how many samples they hold depends on how busy the machine is
PATIENCE_S = 60  # of a visitor, on a machine that is very busy


def broadcaster(name: str) -> None:
    """Sends 20 moving frames at 1 kHz, and a static one."""
    import rclpy
    from rclpy.node import Node
    from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

    rclpy.init()
    node = Node(f"broadcaster_{name}")
    StaticTransformBroadcaster(node).sendTransform(_transform("world", f"{name}_base"))
    moving = TransformBroadcaster(node)
    transforms = [_transform(f"{name}_base", f"{name}_{number}") for number in range(FRAMES)]

    def tick() -> None:
        stamp = node.get_clock().now().to_msg()
        for transform in transforms:
            transform.header.stamp = stamp
        moving.sendTransform(transforms)

    node.create_timer(1.0 / RATE_HZ, tick)
    _spin(node)


def listener(_argument: str) -> None:
    """Looks up each broadcaster's newest frame at 100 Hz."""
    import rclpy
    from rclpy.duration import Duration
    from rclpy.node import Node
    from rclpy.time import Time
    from tf2_ros import Buffer, TransformListener

    rclpy.init()
    node, buffer = Node("listener"), Buffer(Duration(seconds=CACHE_S))
    TransformListener(buffer, node)

    def look() -> None:
        for name in BROADCASTERS:
            frame = f"{name}_{FRAMES - 1}"
            if buffer.can_transform("world", frame, Time()):
                buffer.lookup_transform("world", frame, Time())

    node.create_timer(0.01, look)
    _spin(node)


def watcher(_argument: str) -> None:
    """Waits for transforms of the near future, without ROS's names."""
    from turtlewire import Buffer
    from turtlewire.tf.listener import TransformListener

    buffer = Buffer(CACHE_S * 10**9)
    frame = f"{BROADCASTERS[0]}_0"
    with TransformListener(buffer):
        while True:
            soon_ns = time.time_ns() + 10_000_000
            buffer.can_transform("world", frame, soon_ns, timeout_ns=PATIENCE_S * 10**9)


def server(_argument: str) -> None:
    """Offers a service."""
    import rclpy
    from rclpy.node import Node
    from std_srvs.srv import Trigger

    rclpy.init()
    node = Node("server")

    def answer(_request: Any, response: Any) -> Any:
        response.success = True
        return response

    node.create_service(Trigger, "/ask", answer)
    _spin(node)


def client(_argument: str) -> None:
    """Calls the service at 20 Hz."""
    import rclpy
    from rclpy.node import Node
    from std_srvs.srv import Trigger

    rclpy.init()
    node = Node("client")
    service = node.create_client(Trigger, "/ask")
    node.create_timer(0.05, lambda: service.call_async(Trigger.Request()))
    _spin(node)


def viewer(url: str) -> None:
    """Watches the simulator's page."""
    asyncio.run(_watch(url, messages=None))


def visiting_listener(number: str) -> None:
    """Waits for a transform, and leaves."""
    from turtlewire import Buffer
    from turtlewire.tf.listener import TransformListener

    buffer = Buffer()
    frame = f"{BROADCASTERS[int(number) % 2]}_{int(number) % FRAMES}"
    with TransformListener(buffer):
        buffer.lookup_transform("world", frame, timeout_ns=PATIENCE_S * 10**9)


def visiting_node(number: str) -> None:
    """Brings a static frame and calls the service, and leaves."""
    import rclpy
    from rclpy.node import Node
    from std_srvs.srv import Trigger
    from tf2_ros import StaticTransformBroadcaster

    rclpy.init()
    node = Node(f"visitor_{number}")
    child = f"visitor_{int(number) % 10}"  # listeners keep static frames: no new one each time
    StaticTransformBroadcaster(node).sendTransform(_transform("world", child))
    service = node.create_client(Trigger, "/ask")
    if not service.wait_for_service(PATIENCE_S):
        raise TimeoutError("/ask is not there")
    answer = service.call_async(Trigger.Request())
    rclpy.spin_until_future_complete(node, answer, timeout_sec=PATIENCE_S)
    if not answer.result().success:
        raise RuntimeError("/ask refused")
    node.destroy_node()
    rclpy.shutdown()


def visiting_page(url: str) -> None:
    """Opens the page, watches for a while, and leaves."""
    with urllib.request.urlopen(url, timeout=PATIENCE_S) as page:
        page.read()
    asyncio.run(_watch(url, messages=20))


async def _watch(url: str, messages: int | None) -> None:
    from websockets.asyncio.client import connect

    async with connect(url.replace("http", "ws") + "live", open_timeout=PATIENCE_S) as page:
        received = 0
        async for _message in page:
            received += 1
            if received == messages:
                return


def _transform(parent: str, child: str) -> Any:
    from geometry_msgs.msg import TransformStamped

    transform = TransformStamped(child_frame_id=child)
    transform.header.frame_id = parent
    return transform


def _spin(node: Any) -> None:
    import rclpy
    from rclpy.executors import ExternalShutdownException

    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        rclpy.try_shutdown()


if __name__ == "__main__":
    actors = (broadcaster, listener, watcher, server, client, viewer)
    visitors = (visiting_listener, visiting_node, visiting_page)
    names = {actor.__name__: actor for actor in (*actors, *visitors)}
    name, argument, again = (*sys.argv[1:], "", "")[:3]
    with contextlib.suppress(KeyboardInterrupt):  # how scripts/soak ends those that stay
        names[name](argument)
        while again:  # until it is killed
            names[name](argument)
