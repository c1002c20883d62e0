"""The pages that turtlewire serves, each started as a user does, for pictures and audits."""

from __future__ import annotations

import contextlib
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

ROOT = Path(__file__).resolve().parent.parent
LESSON = ROOT / "build" / "lesson"
SITE = ROOT / "build" / "site"
TESTS = ROOT / "tests"
GRAPH_NODES = Path(__file__).with_name("graph_nodes.py")
WALKER = ROOT / "examples" / "robots" / "walker.urdf.xacro"
LIVE = "document.querySelector('#connection')?.dataset.state === 'live'"


class ServedPage(NamedTuple):
    """A page that can be opened.

    Attributes:
        served: Serves it until the block ends; gives its address.
        ready: A JavaScript expression that is true once the page shows its content.
    """

    served: Callable[[], AbstractContextManager[str]]
    ready: str


def program(name: str) -> str:
    """Return the path of a command of this environment."""
    return str(Path(sys.executable).parent / name)


@contextlib.contextmanager
def running(
    *command: str, prefix: str = "", domain: int | None = None
) -> Iterator[subprocess.Popen[str]]:
    """Run a program until the block ends.

    Args:
        command: The program and its arguments.
        prefix: A folder with installed packages.
        domain: The ROS domain; by default that of this process.
    """
    environment = dict(
        os.environ, TURTLEWIRE_BROWSER="0", TURTLEWIRE_PORT="0", AMENT_PREFIX_PATH=prefix
    )
    if domain is not None:
        environment["ROS_DOMAIN_ID"] = str(domain)
    with subprocess.Popen(
        command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    ) as process:
        try:
            yield process
        finally:
            process.send_signal(signal.SIGINT)


def address_of(process: subprocess.Popen[str]) -> str:
    """Return the address of a program's page as soon as the program prints it.

    Raises:
        RuntimeError: The program ended before.
    """
    lines = []
    for line in process.stdout or ():
        lines.append(line)
        if found := re.search(r"http://\S+", line):
            return found[0]
    raise RuntimeError(f"{process.args!r} ended before its page was there:\n{''.join(lines)}")


@contextlib.contextmanager
def view() -> Iterator[str]:
    """Serve the 3D view of the robot of the URDF tutorial."""
    with tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as programs:
        unpack = (TESTS / "archive.py", "unpack", TESTS / "robots" / "urdf_packages.txt")
        subprocess.run([sys.executable, *unpack, Path(folder) / "src"], check=True)
        tutorial = Path(folder) / "src" / "urdf_tutorial"
        share = Path(folder) / "share"
        index = share / "ament_index" / "resource_index" / "packages"
        index.mkdir(parents=True)
        (index / "urdf_tutorial").touch()
        (share / "urdf_tutorial").symlink_to(tutorial)
        robot = str(tutorial / "urdf" / "06-flexible.urdf")
        for name in ("robot_state_publisher", "joint_state_publisher"):
            programs.enter_context(running(program("ros2"), "run", name, name, robot))
        command = (program("turtlewire"), "view", "--port", "0")
        yield address_of(programs.enter_context(running(*command, prefix=folder)))


@contextlib.contextmanager
def graph() -> Iterator[str]:
    """Serve the page of the graph beside the nodes of a robot with three mistakes."""
    command = (program("turtlewire"), "graph", "--port", "0")
    with running(sys.executable, str(GRAPH_NODES)), running(*command) as process:
        yield address_of(process)


@contextlib.contextmanager
def turtlesim() -> Iterator[str]:
    """Serve the page of turtlesim."""
    with running(program("ros2"), "run", "turtlesim", "turtlesim_node") as node:
        yield address_of(node)


@contextlib.contextmanager
def sliders() -> Iterator[str]:
    """Serve the sliders of a robot's joints."""
    with tempfile.NamedTemporaryFile("w", suffix=".urdf") as robot:
        subprocess.run([program("xacro"), str(WALKER)], stdout=robot, check=True)
        gui = "joint_state_publisher_gui"
        with running(program("ros2"), "run", gui, gui, robot.name) as process:
            yield address_of(process)


@contextlib.contextmanager
def turtle_class() -> Iterator[str]:
    """Serve the page of a class, one student of which runs turtlesim."""
    domain = os.environ.get("ROS_DOMAIN_ID", "0")
    command = (program("turtlewire"), "class", "--domains", f"{domain}-{domain}", "--port", "0")
    with turtlesim(), running(*command) as process:
        yield address_of(process)


@contextlib.contextmanager
def static(folder: Path, page: str = "") -> Iterator[str]:
    """Serve a page of a folder to this machine."""
    handler = partial(_Quiet, directory=folder)
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield f"http://localhost:{server.server_address[1]}/{page}"
        finally:
            server.shutdown()
            thread.join()


class _Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *_words: object) -> None:
        """Print nothing."""


PAGES = {
    "view": ServedPage(view, f"{LIVE} && document.body.innerText.includes('left_runner')"),
    "graph": ServedPage(graph, f"{LIVE} && document.querySelector('#picture .policy')"),
    "turtlesim": ServedPage(turtlesim, f"{LIVE} && document.querySelector('#roster tr')"),
    "sliders": ServedPage(sliders, f"{LIVE} && document.querySelector('[type=range]')"),
    "class": ServedPage(turtle_class, "document.querySelector('article canvas:not([hidden])')"),
    "lesson": ServedPage(partial(static, LESSON), "document.body?.dataset.loadedMs"),
    "site": ServedPage(partial(static, SITE, "index.html"), "true"),
    "site's page": ServedPage(partial(static, SITE, "compatibility.html"), "true"),
}
