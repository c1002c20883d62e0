"""Runs the ``main`` of a node's file up to the point where it spins, and keeps its nodes."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, NoReturn
from unittest.mock import patch

import rclpy
from rclpy.executors import Executor

if TYPE_CHECKING:
    from rclpy.node import Node


class ProgramError(RuntimeError):
    """A program cannot take part in a simulation.

    Attributes:
        hint: Advice.
    """

    def __init__(self, text: str, hint: str) -> None:
        super().__init__(text)
        self.hint = hint


class _Spun(BaseException):  # no Exception: programs catch those
    """Leaves ``main`` where it begins to spin."""


def nodes_of(main: Callable[[], object], arguments: Sequence[str] = ()) -> list[Node]:
    """Run ``main()`` until it spins, within :func:`rclpy_in_step`, and return the nodes it spins.

    Args:
        main: The program's entry point.
        arguments: What follows the program's name in ``sys.argv``.

    Raises:
        ProgramError: The program ended without spinning, or called a blocking function.
    """
    found: list[Node] = []
    with patch.object(sys, "argv", [getattr(main, "__module__", "main"), *arguments]):
        try:
            with _collecting(found):
                main()
        except _Spun:
            pass
        except SystemExit as exit_:
            raise ProgramError(
                f"main() ended the program: {exit_}", "Check its command line arguments."
            ) from exit_
        finally:
            # What `_hand_over` has set.
            for node in found:
                vars(node).pop("destroy_node", None)
    if not found:
        raise ProgramError(
            "main() ended and did not spin a node",
            "Make a node in main() and end with rclpy.spin(node): callbacks run in spin.",
        )
    return found


_found: list[Node] | None = None


@contextlib.contextmanager
def _collecting(found: list[Node]) -> Iterator[None]:
    global _found  # noqa: PLW0603 - programs call rclpy's functions, which know no simulation
    _found = found
    try:
        yield
    finally:
        _found = None


@contextlib.contextmanager
def rclpy_in_step() -> Iterator[None]:
    """Let programs that are imported inside take part in a simulation that is open.

    ``rclpy.init`` and ``shutdown`` leave the simulation's context alone, ``rclpy.spin`` and
    ``Executor.spin`` hand the nodes over, and functions that would block raise
    :class:`ProgramError`.
    """
    with contextlib.ExitStack() as stack:
        for owner, name, function in (
            (rclpy, "init", _init),
            (rclpy, "spin", _spin),
            (rclpy, "shutdown", _ignore),
            (rclpy, "try_shutdown", _ignore),
            (rclpy, "spin_once", _refuse("rclpy.spin_once")),
            (rclpy, "spin_until_future_complete", _refuse("rclpy.spin_until_future_complete")),
            (Executor, "spin", _spin_executor),
        ):
            stack.enter_context(patch.object(owner, name, function))
        yield


def _init(**_: object) -> contextlib.AbstractContextManager[object]:
    return contextlib.nullcontext(rclpy.get_default_context())


def _ignore(*_: object, **__: object) -> None:
    """Ignore a shutdown, because the simulation ends its own context."""


def _spin(node: Node, executor: Executor | None = None) -> NoReturn:
    if executor is not None:
        executor.add_node(node)
        _spin_executor(executor)
    _hand_over([node])


def _spin_executor(executor: Executor) -> NoReturn:
    nodes = list(executor.get_nodes())
    # A node has one executor, and the stage adds it to its own.
    for node in nodes:
        executor.remove_node(node)
    _hand_over(nodes)


def _hand_over(nodes: list[Node]) -> NoReturn:
    if _found is None:
        raise ProgramError(
            "spin was called while the simulation was already spinning",
            "A callback must return; only main() spins.",
        )
    for node in nodes:
        # Programs destroy their nodes when spin ends; here it has only begun.
        vars(node)["destroy_node"] = _ignore
    _found.extend(nodes)
    raise _Spun


def _refuse(name: str) -> Callable[..., Any]:
    def refuse(*_: object, **__: object) -> NoReturn:
        raise ProgramError(
            f"{name} cannot wait here: simulated time does not advance during a wait",
            "Do it in a timer or a callback, and let main() end with rclpy.spin(node).",
        )

    return refuse
