"""Listens to tf and draws the tree of frames: ``frames_<date>.gv``, ``.pdf`` and ``.svg``."""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from collections.abc import Sequence
from typing import Any

import rclpy
from rclpy.exceptions import InvalidTopicNameException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.task import Future
from rclpy.utilities import remove_ros_args
from tf2_ros import DEFAULT_STATIC_TF_TOPIC, DEFAULT_TF_TOPIC, Buffer, TransformListener
from tf2_tools.pdf import pdf_from_drawing
from turtlewire.new_file import new_file
from turtlewire.terminal.printable import printable
from turtlewire.tf.drawing import svg_from_drawing
from turtlewire.tf.frame_tree import FrameLink, FrameTree, read_frame_tree
from turtlewire.tf.tree_drawing import draw_tree

__all__ = [
    "DEFAULT_STATIC_TF_TOPIC",
    "DEFAULT_TF_TOPIC",
    "INTERRUPTED",
    "WAIT_TIME_S",
    "ViewFrames",
    "dot_from_tree",
    "generate_dot",
    "main",
]

WAIT_TIME_S = 5.0
# A shell's status after SIGINT: 128 + 2.
INTERRUPTED = 130


class ViewFrames(Node):
    """Collects transforms.

    Args:
        tf_topic: The topic of transforms that change.
        tf_static_topic: The topic of static transforms.
    """

    def __init__(
        self, tf_topic: str = DEFAULT_TF_TOPIC, tf_static_topic: str = DEFAULT_STATIC_TF_TOPIC
    ) -> None:
        super().__init__("view_frames")
        self._buffer = Buffer(node=self)
        self._listener = TransformListener(
            self._buffer, self, tf_topic=tf_topic, tf_static_topic=tf_static_topic
        )
        self._topics = self.resolve_topic_name(tf_topic), self.resolve_topic_name(tf_static_topic)

    def listen(self, wait_time_s: float) -> FrameTree:
        """Collect for some seconds; return the tree of all transforms since construction.

        Raises:
            ExternalShutdownException: The context was shut down during that time.
        """
        self.get_logger().info(f"Listening to tf data for {wait_time_s} seconds...")
        # Nothing completes the future: the spin ends by its timeout.
        rclpy.spin_until_future_complete(self, Future(), timeout_sec=wait_time_s)
        if not self.context.ok():
            raise ExternalShutdownException
        tree = read_frame_tree(self._buffer.engine)
        if tree.links:
            self.get_logger().info(
                f"Received {len(tree.children)} frames, {len(tree.links)} of them with a parent"
            )
        else:
            self.get_logger().warning(
                f"No tf data received on {self._topics[0]} and {self._topics[1]}. "
                "Is a broadcaster running, in this ROS_DOMAIN_ID?"
            )
        for loop in tree.loops:
            names = printable(" -> ".join([*loop, loop[0]]))
            self.get_logger().warning(
                f"These frames form a loop, no lookup across it works: {names}"
            )
        return tree

    def write(self, tree: FrameTree, output: str) -> None:
        """Write OUTPUT.gv, OUTPUT.pdf and OUTPUT.svg."""
        recorded_time = f"{self.get_clock().now().nanoseconds / 1e9:.6f}"
        drawing = draw_tree(tree, ("view_frames Result", f"Recorded at time: {recorded_time}"))
        contents = {
            ".gv": dot_from_tree(tree, recorded_time).encode(),
            ".pdf": pdf_from_drawing(drawing),
            ".svg": svg_from_drawing(drawing).encode(),
        }
        for ending, content in contents.items():
            with new_file(output + ending) as unfinished, open(unfinished, "wb") as file:
                file.write(content)
            self.get_logger().info(f"Wrote {os.path.abspath(output + ending)}")


def dot_from_tree(tree: FrameTree, recorded_time: str) -> str:
    """Return Graphviz text with a link for each frame, and a legend with the recording's time."""
    if not tree.links:
        return 'digraph G { "No tf data received" }'
    legend = [
        "edge [style=invis];",
        ' subgraph cluster_legend { style=bold; color=black; label ="view_frames Result";',
        f'"Recorded at time: {recorded_time}"[ shape=plaintext ] ;',
        f"}}->{_quoted(tree.roots[0])};",
        "}",
    ]
    return "\n".join(["digraph G {", *map(_link, tree.links.values()), *legend])


def generate_dot(data: dict[str, Any], recorded_time: float | str) -> str:
    """Return Graphviz text of an answer of the service ``tf2_frames``.

    Args:
        data: Its YAML, loaded: of each frame, by its name, the parent and the rates.
        recorded_time: When it was asked, for the legend.
    """
    links = [
        FrameLink(
            child=str(child),
            parent=frame["parent"],
            broadcaster=frame["broadcaster"],
            is_static=False,
            rate_hz=frame["rate"],
            newest=frame["most_recent_transform"],
            oldest=frame["oldest_transform"],
            length=frame["buffer_length"],
        )
        for child, frame in data.items()
    ]
    return dot_from_tree(FrameTree(links), str(recorded_time))


def _link(link: FrameLink) -> str:
    fields = (
        f"Broadcaster: {_escaped(link.broadcaster)}",
        f"Average rate: {link.rate_hz:.3f}",
        f"Buffer length: {link.length:.3f}",
        f"Most recent transform: {link.newest:.6f}",
        f"Oldest transform: {link.oldest:.6f}",
    )
    label = "".join(f"{field}\\n" for field in fields)
    return f'{_quoted(link.parent)} -> {_quoted(link.child)}[label=" {label}"];'


def _quoted(name: str) -> str:
    return f'"{_escaped(name)}"'


def _escaped(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')


def _seconds(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = -1.0
    if not 0.0 <= seconds < float("inf"):
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of seconds")
    return seconds


def _parse(args: Sequence[str]) -> Any:
    parser = argparse.ArgumentParser(
        prog="view_frames", description="Draw the tree of frames that is published on tf."
    )
    parser.add_argument(
        "-t",
        "--wait-time",
        type=_seconds,
        default=WAIT_TIME_S,
        help="seconds to listen (default: %(default)s)",
    )
    parser.add_argument(
        "-o",
        "--output",
        help="name of the files, without a suffix (default: frames_<date>_<time>)",
    )
    parser.add_argument(
        "--tf_topic",
        default=DEFAULT_TF_TOPIC,
        help="topic of transforms that change (default: %(default)s)",
    )
    parser.add_argument(
        "--tf_static_topic",
        default=DEFAULT_STATIC_TF_TOPIC,
        help="topic of static transforms (default: %(default)s)",
    )
    parser.add_argument(
        "--json", action="store_true", help="print the links as JSON, and write no files"
    )
    return parser.parse_args(args)


def main(args: list[str] | None = None) -> int:
    """Listen, then write the files.

    Returns:
        The exit status: 1 if a file cannot be written or the name of a topic is invalid, 130 after
        Ctrl-C.
    """
    wanted = _parse(remove_ros_args(args)[1:])
    rclpy.init(args=args)
    try:
        with ViewFrames(wanted.tf_topic, wanted.tf_static_topic) as node:
            tree = node.listen(wanted.wait_time)
            if wanted.json:
                links = [link._asdict() for link in tree.links.values()]
                print(json.dumps(links, indent=2), flush=True)  # noqa: T201
                return 0
            try:
                node.write(tree, wanted.output or time.strftime("frames_%Y-%m-%d_%H.%M.%S"))
            except OSError as error:
                node.get_logger().error(f"Cannot write {error.filename}: {error.strerror}")
                return 1
    except (KeyboardInterrupt, ExternalShutdownException):
        return INTERRUPTED
    except (InvalidTopicNameException, ValueError) as error:
        print(error, file=sys.stderr)  # noqa: T201
        return 1
    finally:
        rclpy.try_shutdown()
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
