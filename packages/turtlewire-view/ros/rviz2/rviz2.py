"""`rviz2`: the 3D view in the browser, under the name that launch files start."""

from __future__ import annotations

import argparse
import contextlib
import sys

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.utilities import remove_ros_args
from turtlewire.program import program
from turtlewire.terminal.parser import SuggestingParser
from turtlewire.web.desktop import open_browser, wanted_lan
from turtlewire.web.lan import invite
from turtlewire_view import LiveSource, Viewer
from turtlewire_view.rviz_file import RvizFileError, load_rviz

__all__ = ["main"]

_DESCRIPTION = (
    "Shows frames, robots and sensor data in the browser. It accepts RViz's options that apply to "
    "a browser; `turtlewire view` is the same without a node."
)


@program
def main(args: list[str] | None = None) -> None:
    """Serve the page until Ctrl-C or the end of the context."""
    options, others = _parse(remove_ros_args(sys.argv if args is None else ["", *args])[1:])
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        node = rclpy.create_node("rviz2")
        log = node.get_logger()
        if others:
            log.warning(_ignored(others))
        saved = None
        if options.display_config:
            try:
                saved = load_rviz(options.display_config)
            except RvizFileError as error:
                log.warning(str(error))
        if saved is not None and saved.unread:
            log.warning(saved.unread)
        lan = options.lan or wanted_lan()
        viewer = Viewer(LiveSource(node.context.wire), options.fixed_frame, lan=lan, saved=saved)
        try:
            log.info(f"The view is at {viewer.url}")
            if lan:
                invite(viewer.url, log.info)
            open_browser(viewer.url)
            rclpy.spin(node)
        finally:
            viewer.close()


def _ignored(words: list[str]) -> str:
    """Return the notice about ignored words, which must not make a launch file fail."""
    files = [word for word in words if word.endswith(".rviz")]
    hint = f" To show a file: -d {files[0]}" if files else " See --help."
    return f"ignored: {' '.join(words)}.{hint}"


def _parse(words: list[str]) -> tuple[argparse.Namespace, list[str]]:
    """RViz's options, and all other words; options about RViz's window mean nothing."""
    parser = SuggestingParser(prog="rviz2", description=_DESCRIPTION)
    parser.add_argument("-d", "--display-config", default="", help="A .rviz file to show")
    parser.add_argument("-f", "--fixed-frame", default="", help="Look from this frame first")
    parser.add_argument("--lan", action="store_true", help="Also serve other devices")
    for names in (
        ("-t", "--display-title-format"),
        ("-s", "--splash-screen"),
        ("-l", "--ogre-log"),
    ):
        parser.add_argument(*names, nargs="?", help=argparse.SUPPRESS)
    parser.add_argument("--fullscreen", action="store_true", help=argparse.SUPPRESS)
    return parser.parse_known_args(words)
