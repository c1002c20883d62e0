"""A view of what a test publishes, and a page that is no browser."""

from __future__ import annotations

import contextlib
import json
import threading

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from turtlewire import msg, wire
from turtlewire.tf.listener import QOS, STATIC_QOS, TYPE_NAME
from turtlewire.wire.base import TypeId
from turtlewire_view import LiveSource, Viewer

from .fake_view import FakeView, decode_packet
from .looking_down import LOOK_DOWN, REMOVE_ALL, Scene
from .still_source import StillSource

TF = TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME))
LIMIT_S = 120
#: Width and height of windows.
SIZES = {
    "desktop": (1280, 800),
    "phone": (390, 844),
    "small": (320, 640),
    "landscape": (844, 390),
    "zoomed": (320, 256),  # 1280 x 1024 at 400 %
}


class Page:
    """Collects packets, as a browser's page does."""

    def __init__(self, url):
        self._stack = contextlib.ExitStack()
        address = f"{url.replace('http', 'ws', 1)}live"
        self._socket = self._stack.enter_context(connect(address, max_size=None))
        self._news = threading.Condition()
        self._packets = []
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def send(self, kind, /, **fields):
        self._socket.send(json.dumps({"type": kind, **fields}))

    def send_raw(self, message):
        self._socket.send(message)

    def wait_for(self, kind, accept=lambda packet: True, *, after=0):
        """The first packet of a kind that is accepted, of those after the first ``after``."""

        def find():
            return next((p for p in self._packets[after:] if p["type"] == kind and accept(p)), None)

        with self._news:
            assert self._news.wait_for(find, LIMIT_S), (kind, self.kinds(), self._packets[-3:])
            return find()

    def kinds(self):
        return [packet["type"] for packet in self._packets]

    def count(self):
        with self._news:
            return len(self._packets)

    def places(self, packet):
        """Name to place or None, of a packet with frames."""
        names = self.wait_for("names", lambda p: p["version"] == packet["version"])["names"]
        arrays = packet["arrays"]
        return {
            name: tuple(round(float(value), 5) for value in pose[:3]) if known else None
            for name, pose, known in zip(names, arrays["poses"], arrays["known"], strict=True)
        }

    def wait_for_places(self, expected, *, after=0):
        return self.wait_for("frames", lambda p: self.places(p) == expected, after=after)

    def close(self):
        self._stack.close()
        self._thread.join()

    def _run(self):
        try:
            for message in self._socket:
                with self._news:
                    self._packets.append(decode_packet(message))
                    self._news.notify_all()
        except ConnectionClosed:
            pass


class Robot:
    """Publishes frames and messages."""

    def __init__(self):
        self._context = wire.open_context()
        self._node = self._context.create_node("robot")
        self._tf = self._node.create_publisher("/tf", TF, QOS)
        self._tf_static = self._node.create_publisher("/tf_static", TF, STATIC_QOS)

    def send(self, parent, child, place, stamp_s, *, static=False):
        """Publish a transform when the view is there to hear it."""
        publisher = self._tf_static if static else self._tf
        assert self.wait_for(publisher.is_heard), self._context.graph.endpoints()
        publisher.publish(msg.serialize(transform_message(parent, child, place, stamp_s)))

    def wait_for(self, predicate):
        """Whether it becomes true, looked at after each change of the graph."""
        return self._context.graph.wait_for(predicate, LIMIT_S * 10**9)

    def publisher(self, topic, type_name, qos):
        identity = TypeId(type_name, msg.type_hash(type_name))
        return self._node.create_publisher(topic, identity, qos)

    def close(self):
        self._context.close()


def transform_message(parent, child, place, stamp_s):
    transform = msg.get_message("geometry_msgs/msg/TransformStamped")(child_frame_id=child)
    transform.header.frame_id = parent
    transform.header.stamp.sec = int(stamp_s)
    transform.header.stamp.nanosec = round(stamp_s % 1 * 1e9)
    translation = transform.transform.translation
    translation.x, translation.y, translation.z = map(float, place)
    return msg.get_message(TYPE_NAME)(transforms=[transform])


@pytest.fixture
def meshes(tmp_path, monkeypatch):
    """The folder of meshes of ``arm``, the only installed package."""
    packages, folder = (
        tmp_path / "share/ament_index/resource_index/packages",
        tmp_path / "share/arm",
    )
    packages.mkdir(parents=True)
    (packages / "arm").touch()
    (folder / "meshes").mkdir(parents=True)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    return folder / "meshes"


@pytest.fixture
def robot():
    robot = Robot()
    yield robot
    robot.close()


@pytest.fixture
def viewer():
    viewer = Viewer(LiveSource(), port=0)
    yield viewer
    viewer.close()


@pytest.fixture
def open_view_page():
    pages = []

    def open_view_page(viewer):
        pages.append(Page(viewer.url))
        return pages[-1]

    yield open_view_page
    for page in pages:
        page.close()


@pytest.fixture
def page(viewer, open_view_page):
    return open_view_page(viewer)


@pytest.fixture
def fake():
    """A server that says what the test wants."""
    with contextlib.closing(FakeView()) as view:
        yield view


@pytest.fixture
def open_view(browser_3d):
    """Opens pages of the view; fails the test when one reports an error."""
    contexts, errors = [], []

    def open_view(url: str, script: str = "", **options):
        context = browser_3d.new_context(**{"viewport": {"width": 1200, "height": 800}, **options})
        contexts.append(context)
        context.set_default_timeout(1000 * LIMIT_S)
        page = context.new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.add_init_script(script)
        page.goto(url)
        page.wait_for_selector("#connection[data-state=live]")
        return page

    yield open_view
    for context in contexts:
        context.close()
    assert errors == []


@pytest.fixture(scope="module")
def shown_page(browser_3d):
    """One page for all tests: its displays are removed after each."""
    source = StillSource()
    viewer = Viewer(source, "map", port=0)
    context = browser_3d.new_context(viewport={"width": 900, "height": 700}, color_scheme="light")
    page = context.new_page()
    errors = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on("console", lambda line: errors.append(line.text) if line.type == "error" else None)
    page.goto(viewer.url)
    page.wait_for_selector("#connection[data-state=live]")
    page.evaluate(LOOK_DOWN)
    yield page, source, errors
    context.close()
    viewer.close()


@pytest.fixture
def scene(shown_page):
    page, source, errors = shown_page
    yield Scene(page, source, len(source.topics()))
    page.evaluate(REMOVE_ALL)
    page.evaluate("document.querySelector('#looks').open = false")  # open, it covers the picture
    seen, errors[:] = errors[:], []
    assert seen == []
