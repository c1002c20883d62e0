"""The model with its screen, without ROS, and the page of it in a real browser."""

from __future__ import annotations

import queue
import threading
import time

import pytest

from turtlesim import page_commands
from turtlesim.crowd import Crowd
from turtlesim.model import TICK_NS, Pen, World
from turtlesim.picture import Scene, pen_of
from turtlesim.screen import Screen
from turtlesim.transform_view import TransformView
from turtlewire.wire import open_context

BLUE = (69, 86, 255)


class SharedWorld(World):
    """A world that the test's thread may change while the simulator's thread steps it."""

    def __init__(self) -> None:
        self._lock = threading.RLock()
        super().__init__()

    def spawn(self, *arguments, **keywords):
        with self._lock:
            return super().spawn(*arguments, **keywords)

    def kill(self, name):
        with self._lock:
            return super().kill(name)

    def reset(self):
        with self._lock:
            super().reset()

    def in_order(self):
        with self._lock:
            return super().in_order()

    def step(self, now_ns):
        with self._lock:
            return super().step(now_ns)


class Simulator:
    """The model, stepped in real time in its own thread, and its screen."""

    def __init__(self, *, lan: bool = False) -> None:
        self.world = SharedWorld()
        self._crowd = Crowd()
        self.turtle1 = self.world.spawn_centred()
        self.background = BLUE
        self.speed = 1.0
        self.missing: tuple[str, ...] = ()
        self.commands: list[page_commands.Command] = []
        self._queue: queue.SimpleQueue = queue.SimpleQueue()
        self.wire = open_context(middleware="local")
        self.screen = Screen(
            self._scene(), self._queue.put, TransformView(self.wire, "/", time.time_ns), lan=lan
        )
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def close(self) -> None:
        self._stopping.set()
        self._thread.join()
        self.screen.close()
        self.wire.close()

    def _scene(self) -> Scene:
        turtles = self.world.in_order()
        names, pens = (tuple(map(of, turtles)) for of in (lambda turtle: turtle.name, pen_of))
        return Scene("/sim", names, self.background, self.missing, pens, self.speed)

    def _run(self) -> None:
        start = time.monotonic()
        tick = 0
        while not self._stopping.wait(max(0.0, start + tick * 0.016 - time.monotonic())):
            while not self._queue.empty():
                self._obey(self._queue.get())
            self.screen.set_scene(self._scene())
            if len(self.world.turtles) < 100:
                self.screen.show(self.world.step(tick * TICK_NS))
            else:
                self.screen.show_crowd(self._crowd.step(self.world.in_order(), tick * TICK_NS))
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
        elif isinstance(command, page_commands.PenChange):
            *pen, off = command[1:]
            self.world.turtles[command.turtle].set_pen(Pen(*pen), off=off)
        elif isinstance(command, page_commands.Background):
            self.background = tuple(command)
        elif isinstance(command, page_commands.Speed):
            self.speed = command.factor
        elif isinstance(command, page_commands.Clear):
            self.screen.clear()
        elif isinstance(command, page_commands.Reset):
            self.world.reset()
            self.turtle1 = self.world.spawn_centred()
            self.screen.clear()


@pytest.fixture
def make_simulator(monkeypatch):
    """Starts simulators, each at its own port.

    One that follows another may take its port again.
    """
    monkeypatch.setenv("TURTLEWIRE_PORT", "0")
    simulators = []

    def make_simulator(port: str = "0", *, lan: bool = False) -> Simulator:
        monkeypatch.setenv("TURTLEWIRE_PORT", port)
        simulators.append(Simulator(lan=lan))
        return simulators[-1]

    yield make_simulator
    for simulator in simulators:
        simulator.close()


@pytest.fixture
def simulator(make_simulator):
    return make_simulator()


@pytest.fixture
def open_page(browser):
    """Opens pages; fails the test when one reports an error."""
    contexts, errors = [], []

    def open_page(url: str, **options):
        context = browser.new_context(**{"viewport": {"width": 1200, "height": 800}, **options})
        contexts.append(context)
        page = context.new_page()
        page.set_default_timeout(120_000)
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on(
            "request",
            lambda request: (
                errors.append(request.url)
                if not request.url.startswith((url, "blob:", "data:"))
                else None
            ),
        )
        page.goto(url)
        page.wait_for_function(
            "() => document.querySelector('#connection').dataset.state === 'live' && "
            "document.querySelector('#roster tr')"
        )
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert errors == []


@pytest.fixture
def page(simulator, open_page):
    return open_page(simulator.screen.url)
