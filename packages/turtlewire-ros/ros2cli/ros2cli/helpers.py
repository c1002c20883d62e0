"""Small functions that extensions of ``ros2`` share."""

from __future__ import annotations

import functools
import os
import sys
import time
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import unsigned_int as _unsigned_int
from ros2cli.output import tell
from turtlewire.distro import LYRICAL, since

if TYPE_CHECKING:
    from turtlewire.wire.base import Graph

#: The number of words, for argparse, of an argument that can be chosen: at most one, or one.
OPTIONAL = "?" if since(LYRICAL) else None

_NO_DISCOVERY = """\
Warning: ROS_AUTOMATIC_DISCOVERY_RANGE=OFF with no ROS_STATIC_PEERS configured.
No discovery mechanism is available. Results will be empty.
Either:
  - Set ROS_STATIC_PEERS to specify peers explicitly, or
  - Change ROS_AUTOMATIC_DISCOVERY_RANGE to LOCALHOST or SUBNET"""


def get_ros_domain_id() -> int:
    """Return the number of the domain, from ``ROS_DOMAIN_ID``; 0 by default."""
    return int(os.environ.get("ROS_DOMAIN_ID") or 0)


def check_discovery_configuration() -> None:
    """Warn, once in a process, if its nodes can discover none of other processes."""
    _check_discovery()


@functools.cache
def _check_discovery() -> None:
    from turtlewire.wire.environment import Range, discovery

    chosen = discovery()
    if chosen.range == Range.OFF and not chosen.static_peers:
        tell(_NO_DISCOVERY)


def before_invocation(func: Callable[..., Any], hook: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that calls ``hook(func, …)`` with its arguments before ``func``."""

    @functools.wraps(func)
    def wrapper(*args: Any, **kwargs: Any) -> Any:
        hook(func, *args, **kwargs)
        return func(*args, **kwargs)

    return wrapper


def bind(func: Callable[..., Any], *args: Any, **kwargs: Any) -> Callable[..., Any]:
    """`functools.partial` that keeps name and documentation of ``func``."""
    return functools.update_wrapper(functools.partial(func, *args, **kwargs), func)


def pretty_print_call(func: Callable[..., Any], *args: Any, **kwargs: Any) -> None:
    """Print a call as it would be written."""
    words = [*map(repr, args), *(f"{name}={value!r}" for name, value in kwargs.items())]
    print(f"{func.__name__}({', '.join(words)})")


def collect_stdin() -> str:
    """Return all of stdin, read line by line until its end."""
    return "".join(sys.stdin)


def interactive_select(items: Iterable[str], prompt: str = "Select an item:") -> str | None:
    """Let the user choose one of several texts in the terminal, with ``fzf``.

    Without a terminal or ``fzf``, a line on stderr says so.

    Args:
        items: The texts, each of one line.
        prompt: Text in front of the user's input.

    Returns:
        The chosen text, or None.
    """
    import subprocess

    if sys.stdin is None or not sys.stdin.isatty():
        tell("Error: Interactive selection requires a TTY terminal.")
        return None
    words = ["fzf", "--prompt", f"{prompt} ", "--height", "40%", "--reverse"]
    try:
        done = subprocess.run(  # noqa: S603  the words are constant but for the prompt
            words, input="\n".join(items), stdout=subprocess.PIPE, text=True, check=False
        )
    except FileNotFoundError:
        tell(
            "Error: fzf is not installed. Install it to choose from a list (apt install fzf), or"
            " type the name."
        )
        return None
    return done.stdout.rstrip("\n") or None


def select_topic(graph: Graph, prompt: str) -> str | None:
    """Let the user choose a topic; returns None without topics or without a choice."""
    from ros2cli.graph import topics

    return _select("topics", [name for name, _ in topics(graph)], prompt)


def select_node(graph: Graph, prompt: str) -> str | None:
    """Let the user choose a node; returns None without nodes or without a choice."""
    from ros2cli.graph import node_names

    return _select("nodes", list(dict.fromkeys(node_names(graph))), prompt)


def _select(kind: str, names: list[str], prompt: str) -> str | None:
    if not names:
        tell(f"No {kind} available to select from.")
        return None
    return interactive_select(names, prompt)


def unsigned_int(string: str) -> int:
    """Return a whole number from zero, for argparse.

    Raises:
        ArgumentTypeError: The number is negative.
    """
    return _unsigned_int(string)


def wait_for(predicate: Callable[[], bool], timeout: float, period: float = 0.1) -> bool:
    """Poll a predicate, for conditions that no event announces.

    Args:
        predicate: The condition.
        timeout: Seconds until the last question.
        period: Seconds between questions.

    Returns:
        Whether it was true in time.
    """
    deadline = time.monotonic() + timeout
    while not predicate():
        rest = deadline - time.monotonic()
        if rest <= 0:
            # Asked once more: it may have become true during the last sleep.
            return predicate()
        time.sleep(min(period, rest))
    return True
