"""The page in a real browser, on the model and its screen (no ROS; `test_turtlesim_node.py` has the way through ROS)."""

from __future__ import annotations

import json
import math
import queue
import shutil
import socket
import threading
import time

import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from turtlesim import page_commands
from turtlesim.model import TICK_NS, World
from turtlesim.screen import Scene, Screen

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
        self.screen = Screen(self._scene(), self._queue.put)
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def close(self) -> None:
        self._stopping.set()
        self._thread.join()
        self.screen.close()

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
        elif isinstance(command, page_commands.Spawn):
            self.world.spawn(*command)
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
    page.wait_for_function("([s, t]) => document.querySelector(s).textContent.includes(t)", arg=[selector, text])


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


def is_ground(colour: tuple[int, ...]) -> bool:
    return math.dist(colour[:3], BLUE) < 45


def test_the_turtle_is_shown_where_it_is(simulator, open_page):
    page = open_page(simulator.screen.url)
    middle = simulator.turtle1.x
    wait_for_text(page, "#roster", "turtle1")
    wait_for_text(page, "#roster", "5.54")
    assert wait_for_pixel(page, "turtles", middle, middle, lambda colour: colour[3] > 200)  # the shell
    assert pixel(page, "turtles", 2.0, 2.0)[3] == 0
    assert is_ground(pixel(page, "ground", 2.5, 2.5))
    assert page.title() == "turtlesim /sim"


def test_an_arrow_key_is_one_command_and_the_pen_draws(simulator, open_page):
    page = open_page(simulator.screen.url)
    middle = simulator.turtle1.x
    page.keyboard.press("ArrowUp")
    wait_for_pixel(page, "turtles", middle + 2.0, middle, lambda colour: colour[3] > 200)
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


def test_another_turtle_can_be_chosen(simulator, open_page):
    simulator.world.spawn(4.0, 2.0, 0.0, "turtle2")
    page = open_page(simulator.screen.url)
    wait_for_text(page, "#words", "turtle1 is 1.54 m ahead and 3.54 m to the left of turtle2")
    page.get_by_role("button", name="turtle2").click()
    assert page.inner_text("#driven") == "turtle2"
    page.keyboard.press("ArrowUp")
    wait_for_pixel(page, "turtles", 6.0, 2.0, lambda colour: colour[3] > 200)
    assert simulator.commands == [page_commands.Drive("turtle2", 2.0, 0.0)]
    wait_for_text(page, "#words", "of turtle1")


def test_two_browsers_show_the_same_world(simulator, open_page):
    one = open_page(simulator.screen.url)
    middle = simulator.turtle1.x
    one.keyboard.press("ArrowUp")
    wait_for_pixel(one, "ground", middle + 0.5, middle, is_pen)
    two = open_page(simulator.screen.url)
    wait_for_pixel(two, "ground", middle + 0.5, middle, is_pen)  # drawn before it came
    two.get_by_role("button", name="New turtle").click()
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
        wait_for_pixel(page, "turtles", 2.0, 3.0, lambda colour: colour[3] > 200)
    finally:
        again.close()


def test_a_missing_turtle_is_offered(simulator, open_page):
    page = open_page(simulator.screen.url)
    assert not page.is_visible("#hint")
    simulator.missing = ("turtle2",)
    page.get_by_role("button", name="Spawn turtle2").click()
    wait_for_pixel(page, "turtles", 4.0, 2.0, lambda colour: colour[3] > 200)
    assert simulator.commands == [page_commands.Spawn(4.0, 2.0, 0.0, "turtle2")]
    simulator.missing = ()
    page.wait_for_selector("#hint", state="hidden")


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
