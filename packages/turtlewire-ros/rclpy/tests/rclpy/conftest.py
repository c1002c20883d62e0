"""A context on the in-process middleware, a node and an executor.

Modules that need other middlewares have a `middleware` of their own.
"""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
import threading
import time

import pytest

from rclpy.context import Context
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node


@pytest.fixture
def middleware():
    return "local"


@pytest.fixture
def context(middleware, monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", middleware)
    with Context() as context:
        yield context


@pytest.fixture
def node(context):
    node = Node("tested", context=context)
    yield node
    node.destroy_node()


@pytest.fixture
def executor(context, node):
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    yield executor
    executor.shutdown()


@pytest.fixture
def pool(context, node):
    executor = MultiThreadedExecutor(3, context=context)
    executor.add_node(node)
    yield executor
    executor.shutdown()


@pytest.fixture
def spin_until(executor):
    """Run callbacks until something is true; fails after a minute."""

    def spin(predicate):
        deadline = time.monotonic() + 60
        while not predicate():
            assert time.monotonic() < deadline, "it never became true"
            executor.spin_once(timeout_sec=0.5)

    return spin


@pytest.fixture
def spinning(context):
    """Spins an executor in a thread; the thread is joined at the end."""
    started = []

    def start(executor):
        thread = threading.Thread(target=executor.spin)
        thread.start()
        started.append((executor, thread))

    yield start
    for executor, thread in started:
        assert executor.shutdown(60)
        thread.join(60)
        assert not thread.is_alive()


@pytest.fixture
def later():
    """Calls something in another thread in a moment, while the test waits."""
    timers = []

    def start(call, *arguments):
        timers.append(threading.Timer(0.05, call, arguments))
        timers[-1].start()

    yield start
    for timer in timers:
        timer.join()


class Program:
    """A Python program in a separate process, whose output is read line by line."""

    def __init__(self, source: str, *arguments: str) -> None:
        command = [sys.executable, "-u", "-c", textwrap.dedent(source), *arguments]
        self.process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )

    def read_line(self) -> str:
        line = b""
        while not line.endswith(b"\n") and (byte := os.read(self.process.stdout.fileno(), 1)):
            # one by one: what a buffered reader took beyond the line would be lost to communicate()
            line += byte
        return line.decode().rstrip("\n")

    def send_signal(self, signum: int) -> None:
        self.process.send_signal(signum)

    def finish(self) -> tuple[int, str, str]:
        """Exit status, what is left of its output, and its errors."""
        output, errors = self.process.communicate(timeout=60)
        return self.process.returncode, output, errors


@pytest.fixture
def program():
    started: list[Program] = []

    def start(source, *arguments):
        started.append(Program(source, *arguments))
        return started[-1]

    yield start
    for each in started:
        if each.process.poll() is None:
            each.process.kill()
            each.process.communicate()
