"""Memory of `turtlewire view` and its page while topics, displays and pages come and go.

`python -m benchmarks.view_growth [--minutes M] [--every SECONDS]` prints a line at intervals: the
resident memory, file descriptors and threads of the server; the JavaScript heap of the page after a
collection, its DOM nodes, and the objects of three.js on the graphics card. A robot publishes 30
moving frames at 30 Hz; each round opens new topics, shows them in the page and in a second page,
and closes them. The first minute fills the history of frames.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import shutil
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from benchmarks.view_page import FLAGS

FRAMES, RATE_HZ = 30, 30
KINDS = {
    "nav_msgs/msg/Path": "path",
    "visualization_msgs/msg/Marker": "marker",
    "sensor_msgs/msg/PointCloud2": "point_cloud",
    "sensor_msgs/msg/Image": "image",
}
SHOW = """async (wanted) => {
    const { displays } = await import("./js/main.js");
    for (const { kind, topic } of wanted) await displays.add({ kind, topic, id: topic });
}"""
HIDE = """async (wanted) => {
    const { displays } = await import("./js/main.js");
    for (const { topic } of wanted) displays.remove(topic);
}"""
SEEN = """async (wanted) => {
    const { displays } = await import("./js/main.js");
    const parts = displays.list.filter(({ partNames }) => partNames?.size > 0);
    return parts.length === wanted.length;
}"""
HELD = """async () => {
    const { stage } = await import("./js/main.js");
    const { geometries, textures, programs } = stage.view.held;
    return [geometries, textures, programs];
}"""


def main(seconds: float, every_s: float) -> None:
    with running_view() as (url, server_pid), robot() as node, browser(url) as page:
        print(
            "   s  rounds  RSS kB  fds  threads  heap kB  nodes  geometries  textures  programs",
            flush=True,
        )
        begin, rounds, told = time.monotonic(), 0, 0.0
        while (elapsed := time.monotonic() - begin) < seconds or told <= seconds:
            if elapsed >= told:
                values = [*server_values(server_pid), *page_values(page)]
                print(
                    f"{elapsed:5.0f} {rounds:6d}", *(f"{value:8d}" for value in values), flush=True
                )
                told += every_s
            come_and_go(page, url, node, rounds)
            rounds += 1


def come_and_go(page: Any, url: str, node: Any, number: int) -> None:
    """Topics that did not exist before, shown by the page and told to another one; their end."""
    from websockets.sync.client import connect

    wanted = [{"kind": kind, "topic": f"/{kind}_{number}"} for kind in KINDS.values()]
    with contextlib.ExitStack() as stack:
        senders = [
            stack.enter_context(sending(node, each["topic"], type_name))
            for each, type_name in zip(wanted, KINDS, strict=True)
        ]
        page.evaluate(SHOW, wanted)
        with connect(url.replace("http", "ws", 1) + "live", max_size=None) as other:
            other.recv()
            for sender in senders:
                sender.wait(60)
            page.wait_for_function(SEEN, arg=wanted)
        page.evaluate(HIDE, wanted)


@contextlib.contextmanager
def sending(node: Any, topic: str, type_name: str) -> Iterator[threading.Event]:
    """Publish on a topic, 30 times a second; the event is set after some messages were heard."""
    from turtlewire import msg
    from turtlewire.wire.base import TypeId
    from turtlewire.wire.qos import QoS

    publisher = node.create_publisher(topic, TypeId(type_name, msg.type_hash(type_name)), QoS())
    cdr, ended, heard = msg.serialize(message_of(type_name)), threading.Event(), threading.Event()

    def run() -> None:
        count = 0
        while not ended.wait(1 / RATE_HZ):
            publisher.publish(cdr)
            count += publisher.is_heard()
            if count == 5:
                heard.set()

    thread = threading.Thread(target=run)
    thread.start()
    try:
        yield heard
    finally:
        ended.set()
        thread.join()
        publisher.close()


def message_of(type_name: str) -> Any:
    """A message with something to see in it."""
    from turtlewire import msg

    message: Any = msg.get_message(type_name)()
    message.header.frame_id = "frame_1"
    if type_name.endswith("Path"):
        message.poses = [msg.get_message("geometry_msgs/msg/PoseStamped")()] * 200
    elif type_name.endswith("Marker"):
        message.type, message.color.a = 1, 1.0
        message.scale.x = message.scale.y = message.scale.z = 1.0
    elif type_name.endswith("Image"):
        message.width, message.height, message.encoding, message.step = 64, 48, "rgb8", 192
        message.data = bytes(64 * 48 * 3)
    else:
        field = msg.get_message("sensor_msgs/msg/PointField")
        message.fields = [
            field(name=name, offset=4 * k, datatype=7, count=1) for k, name in enumerate("xyz")
        ]
        message.width, message.height, message.point_step = 2000, 1, 12
        message.row_step, message.data = 24000, bytes(24000)
    return message


@contextlib.contextmanager
def running_view() -> Iterator[tuple[str, int]]:
    """The command as a user starts it, without a browser; its address and process."""
    command = [str(Path(sys.executable).with_name("turtlewire")), "view", "--port", "0"]
    environment = {**os.environ, "TURTLEWIRE_BROWSER": "0"}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as view:
        assert view.stdout is not None
        url = next(word for word in view.stdout.readline().split() if word.startswith("http"))
        try:
            yield url, view.pid
        finally:
            view.terminate()


@contextlib.contextmanager
def robot() -> Iterator[Any]:
    """A node, and moving frames beside it."""
    from geometry_msgs.msg import TransformStamped
    from tf2_msgs.msg import TFMessage
    from turtlewire import msg, wire
    from turtlewire.tf.listener import QOS, TYPE_NAME
    from turtlewire.wire.base import TypeId

    context, ended = wire.open_context(), threading.Event()
    node = context.create_node("robot")
    tf = node.create_publisher("/tf", TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME)), QOS)
    moving = [TransformStamped(child_frame_id=f"frame_{k}") for k in range(1, FRAMES + 1)]

    def move() -> None:
        count = 0
        while not ended.wait(1 / RATE_HZ):
            count += 1
            for k, transform in enumerate(moving):
                transform.header.frame_id = f"frame_{k // 3}" if k >= 3 else "map"
                stamp = transform.header.stamp
                stamp.sec, stamp.nanosec = divmod(time.time_ns(), 10**9)
                transform.transform.translation.x = 1.0 + count % 30 / 30
            tf.publish(msg.serialize(TFMessage(transforms=moving)))

    thread = threading.Thread(target=move)
    thread.start()
    try:
        yield node
    finally:
        ended.set()
        thread.join()
        context.close()


@contextlib.contextmanager
def browser(url: str) -> Iterator[Any]:
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS)
        page = chromium.new_page(viewport={"width": 1280, "height": 720})
        page.set_default_timeout(120_000)
        page.on("pageerror", lambda error: print("page:", error, file=sys.stderr))
        page.goto(url)
        page.wait_for_selector("#tree .row:has-text('frame_1')")
        yield page
        chromium.close()


def server_values(pid: int) -> list[int]:
    """Resident memory [kB], open files, threads."""
    process = Path(f"/proc/{pid}")
    lines = dict(
        line.split(":", 1) for line in (process / "status").read_text("utf-8").splitlines()
    )
    return [
        int(lines["VmRSS"].split()[0]),
        len(list((process / "fd").iterdir())),
        int(lines["Threads"]),
    ]


def page_values(page: Any) -> list[int]:
    """JavaScript's heap [kB], DOM nodes; geometries, textures and programs of three.js."""
    session = page.context.new_cdp_session(page)
    session.send("HeapProfiler.enable")
    session.send("HeapProfiler.collectGarbage")
    session.send("Performance.enable")
    values = {
        each["name"]: each["value"] for each in session.send("Performance.getMetrics")["metrics"]
    }
    session.detach()
    return [int(values["JSHeapUsedSize"]) // 1024, int(values["Nodes"]), *page.evaluate(HELD)]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=1.0, help="how long topics come and go")
    parser.add_argument("--every", type=float, default=10.0, help="seconds between two lines")
    given = parser.parse_args()
    main(60 * given.minutes, given.every)
