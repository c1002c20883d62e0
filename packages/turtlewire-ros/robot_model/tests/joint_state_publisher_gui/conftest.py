"""The sliders with their page, without ROS, and the page in a real browser."""

from __future__ import annotations

import math
import queue

import pytest

from joint_state_publisher.joints import FreeJoint, JointSet, MimicRule
from joint_state_publisher_gui.screen import SliderScreen
from joint_state_publisher_gui.sliders import Sliders


def make_joints() -> JointSet:
    """A robot with one joint of each kind."""
    return JointSet(
        "crane",
        ["lift", "elbow", "wrist", "swivel", "twin"],
        {
            "lift": FreeJoint("lift", "prismatic", 0.1, 0.5, 0.3, 0.5, position=0.3),
            "elbow": FreeJoint("elbow", "revolute", -1.0, 2.0, 0.0, 2.5, position=0.0),
            "swivel": FreeJoint("swivel", "continuous", -math.pi, math.pi, 0.0, position=0.0),
        },
        {"wrist": MimicRule("elbow", -0.5, 0.25), "twin": MimicRule("swivel", 1.0, 0.0)},
        {"wrist": "revolute", "twin": "continuous"},
    )


class Gui:
    """Sliders, their page, and the commands that came from it."""

    def __init__(self) -> None:
        self.joints = make_joints()
        self.sliders = Sliders(self.joints)
        self.commands: queue.SimpleQueue = queue.SimpleQueue()
        self.screen = SliderScreen("/joint_state_publisher", self.sliders, self._obey)

    def _obey(self, command) -> None:
        self.sliders.obey(command)
        self.commands.put(command)

    def next_command(self):
        return self.commands.get(timeout=60)


@pytest.fixture
def gui(monkeypatch):
    monkeypatch.setenv("TURTLEWIRE_PORT", "0")
    gui = Gui()
    yield gui
    gui.screen.close()


@pytest.fixture
def open_page(browser):
    """Opens pages; fails the test when one reports an error or asks another server."""
    contexts, errors = [], []

    def open_page(url: str, **options):
        context = browser.new_context(**{"viewport": {"width": 1200, "height": 800}, **options})
        contexts.append(context)
        page = context.new_page()
        page.set_default_timeout(120_000)
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on(
            "request",
            lambda request: None if request.url.startswith(url) else errors.append(request.url),
        )
        page.goto(url)
        page.wait_for_selector("#connection[data-state=live]")
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert errors == []


@pytest.fixture
def page(gui, open_page):
    return open_page(gui.screen.url)
