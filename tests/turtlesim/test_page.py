"""The page in a real browser, on the model and its screen (no ROS; `test_turtlesim_node.py` has the way through ROS)."""

from __future__ import annotations

import base64
import json
import math
import os
import queue
import shutil
import socket
import threading
import time
from pathlib import Path

import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from turtlesim import page_commands
from turtlesim.model import TICK_NS, World
from turtlesim.screen import Scene, Screen
from turtlesim.transform_view import TransformView
from turtlewire import msg
from turtlewire.tf import listener
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId

CHROMIUM = shutil.which("chromium")
BROWSER_FLAGS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
GOLDEN_PICTURE = Path(__file__).parent.parent / "golden" / "page" / "field.png"
#: Mean difference of all colour channels of two PNG files, both scaled to 200 x 200, so that fonts do not matter.
DIFFERENCE_OF_PICTURES = """async (pictures) => {
    const [a, b] = await Promise.all(pictures.map(async (png) => {
        const image = new Image();
        image.src = `data:image/png;base64,${png}`;
        await image.decode();
        const ctx = new OffscreenCanvas(200, 200).getContext('2d');
        ctx.drawImage(image, 0, 0, 200, 200);
        return ctx.getImageData(0, 0, 200, 200).data;
    }));
    return a.reduce((sum, value, k) => sum + Math.abs(value - b[k]), 0) / a.length;
}"""
BLUE = (69, 86, 255)
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no chromium in PATH (Debian: apt install chromium)")


class Simulator:
    """The model, stepped in real time in a thread of its own, and its screen."""

    def __init__(self) -> None:
        self.world = World()
        self.turtle1 = self.world.spawn_centred()
        self.background = BLUE
        self.missing: tuple[str, ...] = ()
        self.commands: list[page_commands.Command] = []
        self._queue: queue.SimpleQueue = queue.SimpleQueue()
        self.wire = open_context(middleware="local")
        self.screen = Screen(self._scene(), self._queue.put, TransformView(self.wire, "/", time.time_ns))
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def close(self) -> None:
        self._stopping.set()
        self._thread.join()
        self.screen.close()
        self.wire.close()

    def _scene(self) -> Scene:
        return Scene("/sim", tuple(sorted(self.world.turtles)), self.background, self.missing)

    def _run(self) -> None:
        start = time.monotonic()
        tick = 0
        while not self._stopping.wait(max(0.0, start + tick * 0.016 - time.monotonic())):
            while not self._queue.empty():
                self._obey(self._queue.get())
            self.screen.set_scene(self._scene())
            self.screen.show(self.world.step(tick * TICK_NS))
            tick += 1

    def _obey(self, command: page_commands.Command) -> None:
        self.commands.append(command)
        if isinstance(command, page_commands.Drive):
            self.world.turtles[command.turtle].drive(command.linear, 0.0, command.angular)
        elif isinstance(command, page_commands.Rotate):
            self.world.turtles[command.turtle].rotate_to(command.theta)
        elif isinstance(command, page_commands.Spawn):
            self.world.spawn(*command)
        elif isinstance(command, page_commands.Teleport):
            self.world.turtles[command.turtle].teleport_absolute(*command[1:])
        elif isinstance(command, page_commands.Clear):
            self.screen.clear()
        elif isinstance(command, page_commands.Reset):
            self.world.reset()
            self.turtle1 = self.world.spawn_centred()
            self.screen.clear()


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@pytest.fixture
def simulator(monkeypatch):
    monkeypatch.setenv("TURTLEWIRE_PORT", str(free_port()))
    simulator = Simulator()
    yield simulator
    simulator.close()


@pytest.fixture(scope="module")
def browser():
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=BROWSER_FLAGS)
        yield browser
        browser.close()


@pytest.fixture
def open_page(browser):
    """Opens pages; fails the test when one reports an error."""
    contexts, errors = [], []

    def open_page(url: str, **options):
        context = browser.new_context(**{"viewport": {"width": 1200, "height": 800}, **options})
        contexts.append(context)
        page = context.new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on("request", lambda request: errors.append(request.url) if not request.url.startswith((url, "blob:", "data:")) else None)
        page.goto(url)
        page.wait_for_function(
            "() => document.querySelector('#connection').dataset.state === 'live' && document.querySelector('#roster tr')"
        )
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert errors == []


def wait_for_text(page, selector: str, text: str) -> None:
    page.wait_for_function("([s, t]) => document.querySelector(s)?.textContent.includes(t)", arg=[selector, text])


def pixel(page, canvas: str, x: float, y: float) -> tuple[int, ...]:
    """Red, green, blue, alpha of a canvas at a place of the field [m]."""
    code = """([id, x, y]) => {
        const canvas = document.getElementById(id);
        const scale = canvas.width / 500;
        const [column, row] = [x * 45 + 0.5, (499 / 45 - y) * 45 + 0.5].map((value) => Math.round(value * scale));
        return [...canvas.getContext('2d').getImageData(column, row, 1, 1).data];
    }"""
    return tuple(page.evaluate(code, [canvas, x, y]))


def wait_for_pixel(page, canvas: str, x: float, y: float, is_wanted) -> tuple[int, ...]:
    deadline = time.monotonic() + 20
    while not is_wanted(found := pixel(page, canvas, x, y)):
        assert time.monotonic() < deadline, found
        page.wait_for_timeout(30)
    return found


def wait_until(is_done) -> None:
    deadline = time.monotonic() + 20
    while not is_done():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def is_pen(colour: tuple[int, ...]) -> bool:
    return math.dist(colour[:3], (179, 184, 255)) < 12


def is_opaque(colour: tuple[int, ...]) -> bool:
    return colour[3] > 200


def is_ground(colour: tuple[int, ...]) -> bool:
    return math.dist(colour[:3], BLUE) < 45


def test_the_turtle_is_shown_where_it_is(simulator, open_page):
    page = open_page(simulator.screen.url)
    middle = simulator.turtle1.x
    wait_for_text(page, "#roster", "turtle1")
    wait_for_text(page, "#roster", "5.54")
    assert wait_for_pixel(page, "turtles", middle, middle, is_opaque)  # the shell
    assert pixel(page, "turtles", 2.0, 2.0)[3] == 0
    assert is_ground(pixel(page, "ground", 2.5, 2.5))
    assert page.title() == "turtlesim /sim"


def test_an_arrow_key_is_one_command_and_the_pen_draws(simulator, open_page):
    page = open_page(simulator.screen.url)
    middle = simulator.turtle1.x
    page.keyboard.press("ArrowUp")
    wait_for_pixel(page, "turtles", middle + 2.0, middle, is_opaque)
    assert simulator.commands == [page_commands.Drive("turtle1", 2.0, 0.0)]
    assert is_pen(wait_for_pixel(page, "ground", middle + 1.0, middle, is_pen))
    for key in ("ArrowLeft", "ArrowRight", "Control+ArrowUp", "ArrowDown"):
        page.keyboard.press(key)
    page.click("#clear")
    wait_for_pixel(page, "ground", middle + 1.0, middle, is_ground)
    drives = [page_commands.Drive("turtle1", *drive) for drive in ((0.0, 2.0), (0.0, -2.0), (-2.0, 0.0))]
    assert simulator.commands[1:] == [*drives, page_commands.Clear()]


def test_the_pad_drives_by_mouse_touch_and_keyboard(simulator, open_page):
    page = open_page(simulator.screen.url, has_touch=True)
    forward = page.get_by_role("button", name="forward")
    forward.click()
    forward.tap()
    forward.focus()
    page.keyboard.press("Enter")
    page.click("#clear")
    wait_until(lambda: page_commands.Clear() in simulator.commands)
    assert simulator.commands[:-1] == 3 * [page_commands.Drive("turtle1", 2.0, 0.0)]


def test_keys_and_buttons_turn_to_a_heading(simulator, open_page):
    page = open_page(simulator.screen.url)
    headings = {"g": 0.0, "t": 0.7854, "r": 1.5708, "e": 2.3562, "d": 3.1416, "c": -2.3562, "v": -1.5708, "b": -0.7854}  # as in teleop
    for key in [*headings, "f", "F", "q", "Alt+t"]:
        page.keyboard.press(key)
    page.get_by_role("button", name="turn to 90°").click()
    page.get_by_role("button", name="cancel the rotation").click()
    wait_until(lambda: len(simulator.commands) == 12)
    turns = [page_commands.Rotate("turtle1", theta) for theta in headings.values()]
    cancel = page_commands.Cancel("turtle1")
    assert simulator.commands == [*turns, cancel, cancel, page_commands.Rotate("turtle1", 1.5708), cancel]
    wait_for_text(page, "#roster", "89°")  # a rotation ends 0.02 rad before its goal, as in the original
    page.focus("#clear")
    page.keyboard.press("g")  # wherever the focus is
    wait_until(lambda: len(simulator.commands) == 13)


def test_another_turtle_can_be_chosen(simulator, open_page):
    simulator.world.spawn(4.0, 2.0, 0.0, "turtle2")
    page = open_page(simulator.screen.url)
    wait_for_text(page, "#words", "turtle1 is 1.54 m ahead and 3.54 m to the left of turtle2")
    page.get_by_role("button", name="turtle2").click()
    assert page.inner_text("#driven") == "turtle2"
    page.keyboard.press("ArrowUp")
    wait_for_pixel(page, "turtles", 6.0, 2.0, is_opaque)
    assert simulator.commands == [page_commands.Drive("turtle2", 2.0, 0.0)]
    wait_for_text(page, "#words", "of turtle1")


def test_two_browsers_show_the_same_world(simulator, open_page):
    one = open_page(simulator.screen.url)
    middle = simulator.turtle1.x
    one.keyboard.press("ArrowUp")
    wait_for_pixel(one, "ground", middle + 0.5, middle, is_pen)
    two = open_page(simulator.screen.url)
    wait_for_pixel(two, "ground", middle + 0.5, middle, is_pen)  # drawn before it came
    two.get_by_role("button", name="New turtle").press("Enter")  # by keyboard: somewhere
    for page in (one, two):
        wait_for_text(page, "#roster", "turtle2")
        wait_for_text(page, "#announcer", "turtle2 appeared")


def test_a_lost_simulator_is_said_and_found_again(simulator, open_page):
    page = open_page(simulator.screen.url)
    simulator.close()
    wait_for_text(page, "#connection", "connection lost, trying again")
    again = Simulator()
    try:
        again.turtle1.teleport_absolute(2.0, 3.0, 0.0)
        again.world.spawn(9.0, 9.0, 0.0, "newcomer")
        wait_for_text(page, "#connection", "live")
        wait_for_text(page, "#roster", "newcomer")
        wait_for_pixel(page, "turtles", 2.0, 3.0, is_opaque)
    finally:
        again.close()


def test_a_missing_turtle_is_offered(simulator, open_page):
    page = open_page(simulator.screen.url)
    assert not page.is_visible("#hint")
    simulator.missing = ("turtle2",)
    page.get_by_role("button", name="Spawn turtle2").click()
    wait_for_pixel(page, "turtles", 4.0, 2.0, is_opaque)
    assert simulator.commands == [page_commands.Spawn(4.0, 2.0, 0.0, "turtle2")]
    simulator.missing = ()
    page.wait_for_selector("#hint", state="hidden")


def on_screen(page, x: float, y: float) -> tuple[float, float]:
    """Where a place of the field [m] is on the screen."""
    box = page.locator("#turtles").bounding_box()
    scale = box["width"] / 500
    return box["x"] + (x * 45 + 0.5) * scale, box["y"] + ((499 / 45 - y) * 45 + 0.5) * scale


def test_a_turtle_is_chosen_and_dragged_on_the_field(simulator, open_page):
    simulator.world.spawn(4.0, 2.0, 0.5, "turtle2")
    page = open_page(simulator.screen.url)
    wait_for_pixel(page, "turtles", 4.0, 2.0, is_opaque)
    page.mouse.click(*on_screen(page, 4.1, 2.1))
    assert page.inner_text("#driven") == "turtle2"
    page.mouse.move(*on_screen(page, 4.0, 2.0))
    page.mouse.down()
    page.mouse.move(*on_screen(page, 6.0, 7.0))
    page.mouse.move(*on_screen(page, 8.0, 3.0))
    page.mouse.up()
    wait_until(lambda: simulator.commands)
    (command,) = simulator.commands
    assert command == page_commands.Teleport("turtle2", pytest.approx(8.0, abs=0.05), pytest.approx(3.0, abs=0.05), pytest.approx(0.5))
    wait_for_pixel(page, "turtles", 8.0, 3.0, is_opaque)


def test_a_new_turtle_is_placed_on_the_field(simulator, open_page):
    page = open_page(simulator.screen.url)
    page.click("#spawn")
    page.keyboard.press("Escape")
    page.mouse.click(*on_screen(page, 2.0, 2.0))  # nothing is being placed any more
    page.click("#spawn")
    assert page.is_visible("#placing")
    page.mouse.move(*on_screen(page, 2.0, 9.0))
    page.mouse.down()
    page.mouse.move(*on_screen(page, 2.0, 8.0))
    page.mouse.up()
    wait_until(lambda: simulator.commands)
    near = pytest.approx
    assert simulator.commands == [page_commands.Spawn(near(2.0, abs=0.05), near(9.0, abs=0.05), near(-math.pi / 2, abs=0.05), "")]
    assert not page.is_visible("#placing")
    wait_for_pixel(page, "turtles", 2.0, 9.0, is_opaque)


def test_following_keeps_the_driven_turtle_in_the_middle(simulator, open_page):
    page = open_page(simulator.screen.url)
    page.click("#follow")
    simulator.turtle1.teleport_absolute(3.0, 7.0, 0.0)
    middle = 499 / 90
    wait_for_pixel(page, "turtles", middle, middle, is_opaque)
    wait_for_text(page, "#roster", "7.00")
    ground = page.evaluate("() => document.getElementById('ground').getBoundingClientRect().width")
    assert ground == pytest.approx(2.5 * page.locator("#turtles").bounding_box()["width"], abs=2)
    page.click("#follow")
    wait_for_pixel(page, "turtles", 3.0, 7.0, is_opaque)
    assert pixel(page, "turtles", middle, middle)[3] == 0


def test_the_picture_is_what_is_seen(simulator, open_page):
    """The field with two turtles and a drawing, against a picture that was looked at."""
    simulator.world.spawn(4.0, 2.0, 1.0, "turtle2")
    page = open_page(simulator.screen.url, reduced_motion="reduce", viewport={"width": 1200, "height": 500})
    simulator.turtle1.teleport_absolute(8.0, 3.0, 2.0)
    simulator.turtle1.teleport_absolute(8.0, 9.0, 2.0)
    wait_for_pixel(page, "ground", 8.0, 6.0, lambda colour: not is_ground(colour))
    wait_for_pixel(page, "turtles", 8.0, 9.0, is_opaque)
    with page.expect_download() as download:
        page.click("#picture")
    assert download.value.suggested_filename.startswith("turtlesim-20")
    picture = Path(download.value.path()).read_bytes()
    if "TURTLEWIRE_WRITE_GOLDEN" in os.environ:
        GOLDEN_PICTURE.write_bytes(picture)
    difference = page.evaluate(DIFFERENCE_OF_PICTURES, [base64.b64encode(png).decode() for png in (picture, GOLDEN_PICTURE.read_bytes())])
    assert difference < 0.3  # of 255, on average; a missing turtle makes 0.6


def publish_transform(simulator, parent: str, child: str, stamp_ns: int, x: float, y: float) -> None:
    if not hasattr(simulator, "tf"):
        type_id = TypeId(listener.TYPE_NAME, msg.type_hash(listener.TYPE_NAME))
        simulator.tf = simulator.wire.create_node("broadcaster").create_publisher(listener.TOPIC, type_id, listener.QOS)
    transform = msg.get_message("geometry_msgs/msg/TransformStamped")(child_frame_id=child)
    transform.header.frame_id = parent
    transform.header.stamp.sec, transform.header.stamp.nanosec = divmod(stamp_ns, 10**9)
    transform.transform.translation.x, transform.transform.translation.y = x, y
    simulator.tf.publish(msg.serialize(msg.get_message(listener.TYPE_NAME)(transforms=[transform])))


def test_the_frames_are_shown_live_and_a_transform_in_plain_words(simulator, open_page):
    page = open_page(simulator.screen.url)
    assert page.is_visible("#no-frames")
    wait_until(lambda: len(simulator.wire.graph.nodes()) == 1)  # the page's listener is there
    now = time.time_ns()
    for age_s in (2.0, 1.0, 0.0):
        publish_transform(simulator, "world", "turtle1", now - int(age_s * 1e9), 1.0, 3.0)
        publish_transform(simulator, "world", "turtle2", now - int(age_s * 1e9), 4.0, 2.0)
    wait_for_text(page, "#tree", "turtle2")
    wait_for_text(page, "#relation-words", "turtle1 is 3.00 m behind and 1.00 m to the left of turtle2, and looks the same way")
    assert page.inner_text("#tree > li > span") == "world"
    page.wait_for_selector("#tree li li[data-kind='stale'] small:has-text('s old')", timeout=15000)
    publish_transform(simulator, "turtle1", "carrot", time.time_ns(), 0.0, 2.0)
    wait_for_text(page, "#tree li li li", "carrot")
    page.select_option("#source", "carrot")
    page.select_option("#target", "turtle1")
    wait_for_text(page, "#relation-words", "carrot is 2.00 m to the left of turtle1")
    publish_transform(simulator, "elsewhere", "lost", time.time_ns(), 0.0, 2.0)
    wait_for_text(page, "#tree", "lost")
    page.select_option("#source", "lost")
    wait_for_text(page, "#relation-words", "Tf has two or more unconnected trees.")
    page.click("#frames summary")
    wait_until(lambda: not any(node.name == "_turtlesim_page" for node in simulator.wire.graph.nodes()))


def test_the_background_follows_the_parameters(simulator, open_page):
    page = open_page(simulator.screen.url)
    simulator.background = (200, 30, 30)
    wait_for_pixel(page, "ground", 2.5, 2.5, lambda colour: math.dist(colour[:3], (200, 30, 30)) < 45)


@pytest.mark.parametrize(("width", "scheme"), [(360, "light"), (360, "dark"), (1200, "light"), (1200, "dark")])
def test_every_width_and_scheme_fits(simulator, open_page, width, scheme):
    page = open_page(simulator.screen.url, viewport={"width": width, "height": 740}, color_scheme=scheme)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    box = page.locator("#turtles").bounding_box()
    assert box["width"] == pytest.approx(box["height"], abs=1)
    assert box["width"] >= 300
    paper = page.evaluate("getComputedStyle(document.body).backgroundColor")
    assert (sum(map(int, paper[4:-1].split(","))) < 3 * 128) == (scheme == "dark")


def test_a_screen_reader_finds_its_way(simulator, open_page):
    page = open_page(simulator.screen.url)
    page.get_by_role("status").get_by_text("live").wait_for()
    page.get_by_role("cell", name="5.54").first.wait_for()
    page.get_by_role("img", name="The field, 11 by 11 metres, with turtle1 at 5.5, 5.5").wait_for(timeout=15000)
    for name in ("forward", "backward", "turn left", "turn right", "Clear drawing", "Reset", "New turtle"):
        assert page.get_by_role("button", name=name).is_visible()


def test_a_foreign_page_is_refused(simulator, open_page):
    live = simulator.screen.url.replace("http", "ws") + "live"
    with pytest.raises(InvalidStatus) as refused, connect(live, origin="http://evil.example"):
        pass
    assert refused.value.response.status_code == 403
    stranger = Simulator()  # another page of this machine: same host, other port
    try:
        page = open_page(stranger.screen.url)
        outcome = """url => new Promise((resolve) => {
            const socket = new WebSocket(url);
            socket.onopen = () => resolve('open');
            socket.onerror = () => resolve('refused');
        })"""
        assert page.evaluate(outcome, stranger.screen.url.replace("http", "ws") + "live") == "open"
        assert page.evaluate("fetch('/live').then((answer) => answer.status)") == 426
        assert page.evaluate(outcome, live) == "refused"
    finally:
        stranger.close()


def test_what_a_page_sends_wrong_is_answered(simulator):
    with connect(simulator.screen.url.replace("http", "ws") + "live") as raw:
        assert json.loads(raw.recv(timeout=10))["turtles"] == ["turtle1"]
        raw.send('{"type": "drive", "turtle": "turtle1", "linear": "fast", "angular": 0}')
        texts = [message for _ in range(20) if isinstance(message := raw.recv(timeout=10), str)]
        assert [json.loads(text) for text in texts] == [{"type": "error", "text": "linear is a number between -1000000 and 1000000"}]
    assert simulator.commands == []
