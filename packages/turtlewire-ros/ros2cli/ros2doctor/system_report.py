"""What ``ros2 doctor --report`` prints, for a bug report.

These are facts about the computer, the middleware, the environment and the topics.
"""

from __future__ import annotations

import os
import platform
import sys

__all__ = ["sections", "system_report"]


def system_report() -> str:
    """Return all sections, each with a title and a line for every fact."""
    return "\n".join(_block(title, facts) for title, facts in sections())


def sections() -> list[tuple[str, list[tuple[str, object]]]]:
    """Titles and facts: pairs of name and value."""
    from turtlewire.wire.environment import middleware_library, middleware_name

    middleware = middleware_name()
    found: dict[str, dict[str, object]] = {
        "PLATFORM INFORMATION": {
            "system": platform.system(),
            "platform info": platform.platform(),
            "release": platform.release(),
            "processor": platform.machine(),
            "python": f"{platform.python_version()} ({sys.executable})",
        },
        "RMW MIDDLEWARE": {
            "middleware name": middleware,
            "middleware library": middleware_library(middleware),
        },
        "ROS 2 INFORMATION": _ros_information(),
    }
    listed = [(title, list(facts.items())) for title, facts in found.items()]
    return [*listed, ("TOPIC LIST", _topics())]


def _block(title: str, facts: list[tuple[str, object]]) -> str:
    width = max((len(name) for name, _ in facts), default=0)
    return "\n".join([f"\n   {title}", *(f"{name:{width}} : {value}" for name, value in facts)])


def _ros_information() -> dict[str, object]:
    from importlib.metadata import version

    from turtlewire.tf.buffer import CORE
    from turtlewire.wire.environment import discovery, domain_id

    chosen = discovery()
    return {
        "distribution name": os.environ.get("ROS_DISTRO", "jazzy"),
        "turtlewire": f"{version('turtlewire')} ({CORE} core)",
        "domain": domain_id(),
        "discovery range": chosen.range.value,
        "static peers": ";".join(chosen.static_peers) or "none",
        "AMENT_PREFIX_PATH": os.environ.get("AMENT_PREFIX_PATH", ""),
    }


def _topics() -> list[tuple[str, object]]:
    from ros2cli.discovery import discovered_graph
    from ros2cli.graph import endpoints_of_topic, topics

    own = ("/parameter_events", "/rosout")
    with discovered_graph() as graph:
        found: list[tuple[str, object]] = [
            fact
            for name, _ in topics(graph)
            if name not in own
            for fact in (
                ("topic", name),
                ("publisher count", len(endpoints_of_topic(graph, name, "publisher"))),
                ("subscriber count", len(endpoints_of_topic(graph, name, "subscription"))),
            )
        ]
    return found or [("topic", "none"), ("publisher count", 0), ("subscriber count", 0)]
