"""Replacements of rqt's commands: prints which page or command shows the same."""

from __future__ import annotations

import os
import sys

_EQUIVALENTS = {
    "rqt": "turtlewire graph (nodes, topics), turtlewire view (frames, robots, images), turtlewire "
    "foxglove (plots, logs)",
    "rqt_action": "ros2 action list -t",
    "rqt_bag": "turtlewire view BAG, or ros2 bag info BAG",
    "rqt_console": "ros2 topic echo /rosout, or the Log panel of turtlewire foxglove",
    "rqt_graph": "turtlewire graph, or turtlewire graph --save graph.svg",
    "rqt_image_view": "turtlewire view: press Add and choose the image's topic",
    "rqt_logger_level": "ros2 param and --ros-args --log-level NODE:=debug",
    "rqt_msg": "ros2 interface show TYPE",
    "rqt_plot": "the Plot panel of turtlewire foxglove, or turtlewire trajectory BAG … --plot FILE",
    "rqt_publisher": "ros2 topic pub TOPIC TYPE VALUES",
    "rqt_reconfigure": "ros2 param list, get and set",
    "rqt_robot_steering": "ros2 run teleop_twist_keyboard teleop_twist_keyboard",
    "rqt_service_caller": "ros2 service call SERVICE TYPE VALUES",
    "rqt_srv": "ros2 interface show TYPE",
    "rqt_tf_tree": "turtlewire frames, or ros2 run tf2_tools view_frames for a PDF",
    "rqt_topic": "ros2 topic list -t, echo, hz and bw",
}


def equivalent(name: str) -> str:
    """Return a line that says what shows the same as a program of rqt; empty for others."""
    if name not in _EQUIVALENTS and not name.startswith("rqt_"):
        return ""
    return f"turtlewire has no {name}. Use instead: " + (
        _EQUIVALENTS.get(name, _EQUIVALENTS["rqt"])
    )


def main() -> int:
    """Print what shows the same as the program of this name; returns 1."""
    name = os.path.basename(sys.argv[0]).removesuffix(".exe")
    print(equivalent(name), file=sys.stderr)  # noqa: T201 - a command line prints
    return 1
