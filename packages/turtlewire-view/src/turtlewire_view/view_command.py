"""`turtlewire view`: live frames, or the frames of a bag, in the browser, in 3D."""

from __future__ import annotations

import contextlib
import signal
import sys
import threading
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import argparse

    from turtlewire_view.source import Source

__all__ = ["add_view_command"]


def add_view_command(commands: Any) -> None:
    """Add ``view`` to the command's words."""
    from turtlewire.terminal.file_arguments import complete_bags, reporting_errors
    from turtlewire.web.options import add_page_options

    summary = "Show live frames, or the frames of a bag, in 3D in the browser"
    parser = commands.add_parser("view", help=summary, description=summary, allow_abbrev=False)
    bag = parser.add_argument(
        "bag", nargs="?", metavar="BAG", help="Show this bag instead of the network"
    )
    bag.completer = complete_bags
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
    add_page_options(parser)
    parser.set_defaults(run=reporting_errors("view", _view), parser=parser)


def _view(args: argparse.Namespace) -> int:
    """Serve the page until Ctrl-C or SIGTERM."""
    from urllib.parse import urlsplit

    from turtlewire.errors import WireError
    from turtlewire.web.desktop import open_browser, wanted_lan
    from turtlewire.web.lan import invite
    from turtlewire_view.rviz_file import RvizFileError, load_rviz
    from turtlewire_view.viewer import Viewer

    ended = threading.Event()
    signal.signal(signal.SIGTERM, lambda *_: ended.set())
    lan = args.lan or wanted_lan()
    try:
        saved = None if args.display_config is None else load_rviz(args.display_config)
        source = _source(args.bag, args.max_frames)
    except RvizFileError as error:
        print(f"turtlewire view: {error}", file=sys.stderr)
        return 2
    except WireError as error:
        print(f"turtlewire view: {error.in_one_line()}", file=sys.stderr)
        return 2
    with contextlib.ExitStack() as stack:
        stack.callback(source.close)
        viewer = Viewer(source, args.fixed_frame, port=args.port, lan=lan, saved=saved)
        stack.pop_all()
        stack.callback(viewer.close)  # closes the source, too
        if args.port and args.port != urlsplit(viewer.url).port:
            print(f"Port {args.port} is in use: the view uses a free port", flush=True)
        print(f"The view is at {viewer.url} (Ctrl-C ends it)", flush=True)
        if lan:
            invite(viewer.url, print)
        open_browser(viewer.url)
        ended.wait()
    return 0


def _source(bag: str | None, max_frames: int | None) -> Source:
    limit: dict[str, Any] = {} if max_frames is None else {"max_frames": max_frames}
    if bag is None:
        from turtlewire_view.live import LiveSource

        return LiveSource(**limit)
    if bag.endswith(".rviz"):
        from turtlewire_view.rviz_file import RvizFileError

        raise RvizFileError(f"{bag} is not a bag. To load an RViz file: -d {bag}")
    from turtlewire_view.bag_source import BagSource

    source = BagSource(bag, **limit)
    if source.problem:
        print(source.problem, flush=True)
    return source


def _frame_count(text: str) -> int:
    """Return a number of frames on the command line."""
    import argparse

    if not (text.isdecimal() and int(text) > 1):
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of frames, at least 2")
    return int(text)
