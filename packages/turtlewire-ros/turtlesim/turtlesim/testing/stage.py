"""Nodes of one process, in lock-step: their callbacks run in order, when the stage steps."""

from __future__ import annotations

import contextlib
import json
import os
from collections import deque
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import rclpy
from rclpy.executors import SingleThreadedExecutor, TimeoutException
from rclpy.impl.arguments import Arguments
from turtlesim.testing.programs import nodes_of, rclpy_in_step
from turtlewire.wire.local.context import LocalContext

if TYPE_CHECKING:
    from rclpy.node import Node

_MIDDLEWARE = "RMW_IMPLEMENTATION"
#: A node that keeps publishing to itself would never become idle.
_MOST_CALLBACKS = 100_000


class Stage:
    """Nodes on the ``local`` middleware that follow ``/clock``; one stage at a time in a process.

    Attributes:
        wire: The context of all nodes.
        exchange: Called when the nodes have come to rest; returns whether there is anything new
            for them. A stage that shares its topics with another process brings messages here.
    """

    def __init__(self) -> None:
        self._nodes: list[Node] = []
        self._reader = _ReaderInStep()
        with _middleware_of_this_process():
            rclpy.init(args=["--ros-args", *_as_arguments({})])
        wire = rclpy.get_default_context().wire
        assert isinstance(wire, LocalContext)
        self.wire = wire
        self.exchange: Callable[[], bool] = lambda: False
        self._executor = SingleThreadedExecutor()
        wire.replace_reader(self._reader)

    def close(self) -> None:
        """Destroy all nodes and leave the domain."""
        for node in reversed(self._nodes):
            node.destroy_node()
        self._executor.shutdown()
        rclpy.try_shutdown()

    def add(self, node: Node) -> Node:
        """Let a node take part; it is destroyed at the end. Returns the node."""
        self._nodes.append(node)
        self._executor.add_node(node)
        return node

    def start(self, make_node: Callable[[], Node], **parameters: object) -> Node:
        """Make a node with parameters, as a launch file would start it, and let it take part.

        Args:
            make_node: The node's class, or any function that makes it.
            parameters: Initial values of the node's parameters; ``name`` gives the node another
                name.
        """
        with self._arguments(parameters):
            return self.add(make_node())

    def start_program(
        self, main: Callable[[], object], *arguments: str, **parameters: object
    ) -> list[Node]:
        """Run the ``main`` of a node's file as a launch file would, and let its nodes take part.

        It runs up to ``rclpy.spin``. From then on the stage spins.

        Args:
            main: The program's entry point.
            arguments: Its command line.
            parameters: As in :meth:`start`.

        Returns:
            Its nodes.

        Raises:
            ProgramError: The program ended without spinning, or called a blocking function.
        """
        with self._arguments(parameters), rclpy_in_step():
            nodes = [self.add(node) for node in nodes_of(main, arguments)]
        self.come_to_rest()
        return nodes

    @contextlib.contextmanager
    def _arguments(self, parameters: dict[str, object]) -> Iterator[None]:
        """Give nodes that are made inside these parameters."""
        context = rclpy.get_default_context()
        # Nodes read the arguments at their creation. A context has only one set, so it is swapped.
        outer, context._arguments = (
            context.arguments,
            Arguments.parse_global(["--ros-args", *_as_arguments(parameters)]),
        )
        try:
            yield
        finally:
            context._arguments = outer

    def remove(self, node: Node) -> None:
        """End a node before the stage ends."""
        self._nodes.remove(node)
        node.destroy_node()
        self.come_to_rest()

    def come_to_rest(self) -> None:
        """Run callbacks until no more are ready: then all effects of this moment have happened.

        Raises:
            RuntimeError: The nodes call each other without an end.
        """
        for _ in range(_MOST_CALLBACKS):
            # First: the middleware's thread would have done this by now.
            self._reader.run()
            try:
                ready = self._executor._rclpy_scheduler.next(0)
            except TimeoutException:
                if not self.exchange():
                    return
            else:
                self._executor._rclpy_scheduler.run(*ready)
        raise RuntimeError(f"the nodes ran {_MOST_CALLBACKS} callbacks and did not come to rest")


class _ReaderInStep:
    """Replaces the middleware's reader thread, which feeds TF listeners, between callbacks."""

    def __init__(self) -> None:
        self._work: deque[Callable[[], None]] = deque()

    def submit(self, work: Callable[[], None]) -> None:
        """Run ``work`` before the next callback."""
        self._work.append(work)

    def run(self) -> None:
        """Do all there is."""
        while self._work:
            self._work.popleft()()

    def close(self) -> None:
        """Drop the rest."""
        self._work.clear()


@contextlib.contextmanager
def _middleware_of_this_process() -> Iterator[None]:
    """Have `local` chosen, and leave the environment as it was."""
    before = os.environ.get(_MIDDLEWARE)
    os.environ[_MIDDLEWARE] = "local"
    try:
        yield
    finally:
        if before is None:
            del os.environ[_MIDDLEWARE]
        else:
            os.environ[_MIDDLEWARE] = before


def _as_arguments(parameters: dict[str, object]) -> list[str]:
    """Return the arguments after ``--ros-args`` that set these parameters and simulated time."""
    name = parameters.pop("name", None)
    renamed = [] if name is None else ["-r", f"__node:={name}"]
    values = {"use_sim_time": True, **parameters}
    # Parameters are parsed as YAML, and JSON is YAML.
    return renamed + [
        part for key, value in values.items() for part in ("-p", f"{key}:={json.dumps(value)}")
    ]
