"""The visible state of a page: pixels, texts and positions; and transforms for it."""

from __future__ import annotations

import math
import time

from turtlewire import msg
from turtlewire.tf import listener
from turtlewire.wire.base import TypeId

BLUE = (69, 86, 255)


def wait_for_text(page, selector: str, text: str) -> None:
    page.wait_for_function(
        "([s, t]) => document.querySelector(s)?.textContent.includes(t)", arg=[selector, text]
    )


def pixel(page, canvas: str, x: float, y: float) -> tuple[int, ...]:
    """Red, green, blue, alpha of a canvas at a place of the field [m]."""
    code = """([id, x, y]) => {
        const canvas = document.getElementById(id);
        const scale = canvas.width / 500;
        const pixels = [x * 45 + 0.5, (499 / 45 - y) * 45 + 0.5];
        const [column, row] = pixels.map((value) => Math.round(value * scale));
        return [...canvas.getContext('2d').getImageData(column, row, 1, 1).data];
    }"""
    return tuple(page.evaluate(code, [canvas, x, y]))


def wait_for_pixel(page, canvas: str, x: float, y: float, is_wanted) -> tuple[int, ...]:
    deadline = time.monotonic() + 120
    while not is_wanted(found := pixel(page, canvas, x, y)):
        assert time.monotonic() < deadline, found
        page.wait_for_timeout(30)
    return found


def wait_until(is_done) -> None:
    deadline = time.monotonic() + 120
    while not is_done():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def is_at_rest(turtle) -> bool:
    """Return True if the last command of a turtle is over."""
    return turtle.forward == turtle.turning == 0.0


def is_pen(colour: tuple[int, ...]) -> bool:
    """Return True if this is turtle1's line, in the colour of its shell."""
    return math.dist(colour[:3], (0x72, 0xC3, 0xB0)) < 12


def is_opaque(colour: tuple[int, ...]) -> bool:
    return colour[3] > 200


def is_ground(colour: tuple[int, ...]) -> bool:
    return math.dist(colour[:3], BLUE) < 45


def on_screen(page, x: float, y: float) -> tuple[float, float]:
    """Return the position of a point of the field [m] on the screen."""
    box = page.locator("#turtles").bounding_box()
    scale = box["width"] / 500
    return box["x"] + (x * 45 + 0.5) * scale, box["y"] + ((499 / 45 - y) * 45 + 0.5) * scale


def publish_transform(
    simulator, parent: str, child: str, stamp_ns: int, x: float, y: float
) -> None:
    """Publish a transform as soon as the page's listener hears it; its node is there earlier."""
    if not hasattr(simulator, "tf"):
        type_id = TypeId(listener.TYPE_NAME, msg.type_hash(listener.TYPE_NAME))
        simulator.tf = simulator.wire.create_node("broadcaster").create_publisher(
            listener.TOPIC, type_id, listener.QOS
        )
    wait_until(lambda: simulator.tf.subscription_count() > 0)
    transform = msg.get_message("geometry_msgs/msg/TransformStamped")(child_frame_id=child)
    transform.header.frame_id = parent
    transform.header.stamp.sec, transform.header.stamp.nanosec = divmod(stamp_ns, 10**9)
    transform.transform.translation.x, transform.transform.translation.y = x, y
    simulator.tf.publish(msg.serialize(msg.get_message(listener.TYPE_NAME)(transforms=[transform])))
