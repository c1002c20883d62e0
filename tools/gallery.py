"""Makes the pictures of the site's gallery, in ``docs/images``.

The drawings (SVG) come from fixed data and are the same each time; the screenshots need Debian's
chromium, and that of the lesson what ``scripts/lesson`` builds.
"""

from __future__ import annotations

import contextlib
import json
import math
import os
import re
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import served_pages
from picture import CHROMIUM_FLAGS
from playwright.sync_api import sync_playwright
from served_pages import LESSON, address_of, program, running

from turtle_lesson.lesson import load_lesson
from turtlewire import Buffer
from turtlewire.trajectory import Trajectory, compare, plot

if TYPE_CHECKING:
    from playwright.sync_api import Browser

ROOT = Path(__file__).resolve().parent.parent
IMAGES = ROOT / "docs" / "images"
GALLERY = IMAGES / "gallery"
LESSONS = ROOT / "packages" / "turtlewire-class" / "src" / "turtle_lesson" / "lessons"
#: WebGL without a graphics card.
FLAGS_3D = [
    *(flag for flag in CHROMIUM_FLAGS if flag != "--disable-gpu"),
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
]
SECOND = 1_000_000_000
#: The first of up to three domains in a row that a picture uses.
FIRST_DOMAIN = 1 + os.getpid() % 90
#: A browser that starts Python, or a robot's page, on a busy machine.
PATIENCE_MS = 180_000


def main() -> None:
    """Make all pictures."""
    os.environ["ROS_DOMAIN_ID"] = str(FIRST_DOMAIN)
    GALLERY.mkdir(parents=True, exist_ok=True)
    for name, svg in drawings():
        (GALLERY / name).write_text(svg, encoding="utf-8")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium"), args=CHROMIUM_FLAGS
        )
        picture_lesson(browser)
        picture_sliders(browser)
        picture_class(browser)
        picture_graph(browser)
        browser.close()
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium"), args=FLAGS_3D
        )
        picture_view(browser)
        browser.close()


def drawings() -> Iterator[tuple[str, str]]:
    """Yield the drawings as file name and SVG."""
    yield "frames.svg", _on_white(_robot()._repr_svg_())
    shown = _robot().lookup_transform("map", "laser")._repr_html_()
    yield "transform.svg", _on_white(shown[shown.index("<svg") : shown.index("</svg>")] + "</svg>")
    yield "trajectory.svg", _on_white(_compared_runs())


def _robot() -> Buffer:
    """Some transforms of a robot that drives in a room."""
    buffer = Buffer()
    for tick in range(101):
        stamp, turned = SECOND + tick * SECOND // 20, tick / 200
        pose = (0.02 * tick, 0.01 * tick, 0.0), (0.0, 0.0, math.sin(turned), math.cos(turned))
        buffer.set_transform("odom", "base_link", stamp, *pose, sender="odometry")
        if tick % 10 == 0:
            upright = (0.0, 0.0, 0.0, 1.0)
            buffer.set_transform("map", "odom", stamp, (1.0, 2.0, 0.0), upright, sender="slam")
    for child, place in (("camera", (0.3, 0.0, 0.4)), ("laser", (0.2, 0.0, 0.2))):
        turn = (-0.5, 0.5, -0.5, 0.5) if child == "camera" else (0.0, 0.0, 0.0, 1.0)
        buffer.set_static_transform("base_link", child, place, turn, sender="robot_state_publisher")
    return buffer


def _compared_runs() -> str:
    """Return the paths of two estimates next to the true one."""
    angle = np.linspace(0.0, 2 * np.pi, 400)
    poses = np.zeros((400, 7))
    poses[:, 0], poses[:, 1] = 5 * np.cos(angle), 3 * np.sin(2 * angle)
    poses[:, 6] = 1.0
    stamps = SECOND + np.arange(400) * SECOND // 10
    truth = Trajectory(stamps, poses)
    dice = np.random.default_rng(1)
    runs = {}
    for name, size in (("run A", 0.04), ("run B", 0.12)):
        noisy = poses.copy()
        noisy[:, :3] += dice.normal(size=(400, 3)).cumsum(axis=0) * size / 4
        runs[name] = compare(truth, Trajectory(stamps, noisy), "se3")
    return plot({name: run.estimate for name, run in runs.items()}, reference=truth).svg


def _on_white(svg: str) -> str:
    """Return a drawing with a white ground, to be seen on dark pages, too."""
    ground = '<rect width="100%" height="100%" fill="#ffffff"/>'
    return re.sub(r"(<svg[^>]*>)", rf"\1\n{ground}", svg, count=1).rstrip() + "\n"


def picture_lesson(browser: Browser) -> None:
    """The listener's lesson, some seconds after its start."""
    if not (LESSON / "manifest.json").exists():
        sys.exit("run scripts/lesson first, which builds the lesson for the image")
    files = load_lesson(LESSONS / "listener").solution()
    with served_pages.static(LESSON, "#listener") as address:
        page = browser.new_page(viewport={"width": 1280, "height": 860})
        kept = json.dumps(json.dumps({"files": {"listener": files}}))
        page.add_init_script(f"localStorage.setItem('turtlewire-lesson', {kept})")
        page.goto(address)
        page.locator("#relation-words", has_text="ahead").wait_for(timeout=PATIENCE_MS)
        page.wait_for_timeout(2000)
        page.screenshot(path=GALLERY / "lesson.png")
        page.close()


def picture_sliders(browser: Browser) -> None:
    """The sliders of a robot's joints."""
    with served_pages.sliders() as address:
        page = browser.new_page(viewport={"width": 720, "height": 520})
        page.goto(address)
        page.locator("input[type=range]").first.wait_for(timeout=PATIENCE_MS)
        page.screenshot(path=GALLERY / "sliders.png")
        page.close()


def picture_view(browser: Browser) -> None:
    """The robot of the URDF tutorial in ``turtlewire view``, which shows it by itself."""
    with served_pages.view() as address:
        page = browser.new_page(viewport={"width": 1400, "height": 900})
        page.goto(address)
        page.locator(".display", has_text="/robot_description").wait_for(timeout=PATIENCE_MS)
        page.wait_for_timeout(3000)
        page.screenshot(path=IMAGES / "view.png")
        page.close()


def picture_graph(browser: Browser) -> None:
    """The graph of a robot with three mistakes, one of which is selected."""
    with served_pages.graph() as address:
        page = browser.new_page(viewport={"width": 1280, "height": 720})
        page.goto(address)
        page.locator("#problem-count", has_text="3").wait_for(timeout=PATIENCE_MS)
        page.locator("#list li", has_text="/cmd_vel").click()
        page.locator("#selected dd", has_text="Hz").first.wait_for(timeout=PATIENCE_MS)
        page.screenshot(path=IMAGES / "graph.png")
        page.close()


def picture_class(browser: Browser) -> None:
    """The page of a class of three, each of whom runs the demo."""
    domains = range(FIRST_DOMAIN, FIRST_DOMAIN + 3)
    demo = ("launch", "learning_tf2_py", "turtle_tf2_demo.launch.py")
    with contextlib.ExitStack() as programs:
        for domain in domains:
            programs.enter_context(running(program("ros2"), *demo, domain=domain))
        shown = programs.enter_context(
            running(program("turtlewire"), "class", "--domains", f"{domains[0]}-{domains[-1]}")
        )
        page = browser.new_page(viewport={"width": 860, "height": 480})
        page.goto(address_of(shown))
        page.locator("article p", has_text="According to TF").nth(2).wait_for(timeout=PATIENCE_MS)
        page.wait_for_timeout(4000)
        page.screenshot(path=GALLERY / "class.png")
        page.close()


if __name__ == "__main__":
    main()
