"""`turtlewire view`: live frames, a bag or a robot, in the browser, in 3D."""

from __future__ import annotations

import contextlib
import signal
import threading
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import argparse

    from turtlewire_view.package_folders import PackageFolders
    from turtlewire_view.source import Source

__all__ = ["add_view_command"]


def add_view_command(commands: Any) -> None:
    """Add ``view`` to the command's words."""
    from turtlewire.terminal.parser import add_robot_topics, complete_bags, reporting_errors
    from turtlewire.web.desktop import add_page_options
    from turtlewire_view.package_folders import add_package_option

    summary = "Show live frames, a bag or a robot in 3D in the browser"
    parser = commands.add_parser("view", help=summary, description=summary)
    what = parser.add_argument(
        "what",
        nargs="?",
        metavar="BAG|ROBOT",
        help="Show this bag or robot instead of the network: the path of a bag or of a .urdf file, "
        "or a name of the PyPI package robot_descriptions, such as panda",
    )
    what.completer = complete_bags
    add_package_option(parser)
    parser.add_argument(
        "--fixed-frame",
        default="",
        metavar="FRAME",
        help="Fixed frame to start with (default: the root of the largest tree)",
    )
    parser.add_argument(
        "-d",
        "--display-config",
        metavar="FILE",
        help="Load this .rviz file; the page can also save and load such files",
    )
    parser.add_argument(
        "--max-frames",
        type=_frame_count,
        metavar="N",
        help="Show at most this many frames (default: 5000)",
    )
    add_robot_topics(parser)
    add_page_options(parser)
    parser.set_defaults(run=reporting_errors("view", _view), parser=parser)


def _view(args: argparse.Namespace) -> int:
    """Serve the page until Ctrl-C or SIGTERM."""
    from urllib.parse import urlsplit

    from turtlewire.web.desktop import open_browser, wanted_lan
    from turtlewire.web.lan import invite
    from turtlewire_view.rviz_file import load_rviz
    from turtlewire_view.viewer import Viewer

    ended = threading.Event()
    signal.signal(signal.SIGTERM, lambda *_: ended.set())
    lan = args.lan or wanted_lan()
    saved = None if args.display_config is None else load_rviz(args.display_config)
    source, packages = _source(args)
    with contextlib.ExitStack() as stack:
        stack.callback(source.close)
        viewer = Viewer(
            source, args.fixed_frame, port=args.port, lan=lan, saved=saved, packages=packages
        )
        stack.pop_all()
        stack.callback(viewer.close)  # also closes the source
        if args.port and args.port != urlsplit(viewer.url).port:
            print(f"Port {args.port} is in use: the view uses a free port", flush=True)
        print(f"The view is at {viewer.url} (Ctrl-C ends it)", flush=True)
        if lan:
            invite(viewer.url, print)
        open_browser(viewer.url)
        ended.wait()
    return 0


def _source(args: argparse.Namespace) -> tuple[Source, PackageFolders]:
    from turtlewire.tf.tf_topics import TfTopics
    from turtlewire_view.package_folders import PackageFolders
    from turtlewire_view.robots import find_robot

    what: str | None = args.what
    topics = TfTopics(args.topic, args.static_topic)
    if what is not None and topics != TfTopics():
        args.parser.error("--topic and --static-topic are for the network")
    named = dict(args.package)
    limit: dict[str, Any] = {} if args.max_frames is None else {"max_frames": args.max_frames}
    if what is None:
        from turtlewire_view.live import LiveSource

        return LiveSource(**limit, topics=topics), PackageFolders(named)
    if what.endswith(".rviz"):
        from turtlewire_view.rviz_file import RvizFileError

        raise RvizFileError(f"{what} is not a bag. To load an RViz file: -d {what}")
    found = find_robot(what, named)
    if found is not None:
        from turtlewire_view.buffer_source import RobotSource

        return RobotSource(found.robot), found.packages
    return _bag(what, args.fixed_frame, limit), PackageFolders(named)


def _bag(path: str, fixed_frame: str, limit: dict[str, Any]) -> Source:
    from turtlewire_view.bag_source import BagSource
    from turtlewire_view.tree import missing_frame

    source = BagSource(path, **limit)
    for text in (source.problem, missing_frame(fixed_frame, source.buffer.frames())):
        if text:
            print(text, flush=True)
    return source


def _frame_count(text: str) -> int:
    """Return a number of frames on the command line."""
    import argparse

    if not (text.isdecimal() and int(text) > 1):
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of frames, at least 2")
    return int(text)
