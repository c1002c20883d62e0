"""`turtlewire graph`: nodes, topics and mismatches, in the browser or as a file."""

from __future__ import annotations

import contextlib
import signal
import sys
import threading
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import argparse

    from turtlewire_view.graph.picture import Selection

__all__ = ["add_graph_command"]


def add_graph_command(commands: Any) -> None:
    """Add ``graph`` to the command's words."""
    from turtlewire.terminal.parser import complete_files, reporting_errors
    from turtlewire.web.desktop import add_page_options

    summary = "Show nodes, topics and QoS mismatches in the browser, or save them as a picture"
    parser = commands.add_parser("graph", help=summary, description=summary)
    save = parser.add_argument(
        "--save",
        metavar="FILE",
        help="Write this .svg, .dot or .json file instead of opening a page",
    )
    save.completer = complete_files
    parser.add_argument(
        "--topics",
        choices=("all", "connected", "none"),
        default="all",
        help="Show all topics, only those with a publisher and a subscription, or only nodes "
        "(default: %(default)s)",
    )
    parser.add_argument(
        "--filter",
        default="",
        metavar="WORDS",
        help="Show only nodes and topics whose names contain one of these words, and what they "
        "are connected to; --filter=-WORD leaves names out",
    )
    parser.add_argument(
        "--debug",
        action="store_true",
        help="Also show /rosout, /parameter_events, hidden names and the nodes of tools",
    )
    add_page_options(parser)
    parser.set_defaults(run=reporting_errors("graph", _graph), parser=parser)


def _graph(args: argparse.Namespace) -> int:
    from turtlewire_view.graph.picture import Selection

    selection = Selection(args.topics, args.debug, args.filter)
    if args.save is not None:
        return _save(args.save, selection)
    return _serve(args, selection)


def _save(path: str, selection: Selection) -> int:
    """Write a file."""
    from turtlewire import wire
    from turtlewire.doctor import network
    from turtlewire.doctor.setup_findings import wait_for_graph
    from turtlewire.new_file import new_file
    from turtlewire_view.graph.files import writer_for
    from turtlewire_view.graph.picture import read_graph, select

    writer = writer_for(path)
    with contextlib.closing(wire.open_context()) as context:
        wait_for_graph(context.graph)
        picture = read_graph(context.graph, context.domain_id)
    with new_file(path) as unfinished, open(unfinished, "w", encoding="utf-8") as file:
        file.write(writer(picture, selection))
    if not picture.nodes and (others := network.other_domains(picture.domain_id)):
        print(
            f"Domain {picture.domain_id} has no nodes. This computer has nodes on "
            f"{network.named_domains(others)}: export ROS_DOMAIN_ID={others[0]}",
            file=sys.stderr,
        )
    shown = select(picture, selection)
    print(
        f"Wrote {path}: nodes {len(shown.nodes)}, topics {len(shown.topics)}, "
        f"mismatches {len(shown.mismatches)}"
    )
    return 0


def _serve(args: argparse.Namespace, selection: Selection) -> int:
    """Serve the page until Ctrl-C or SIGTERM."""
    from urllib.parse import urlsplit

    from turtlewire import wire
    from turtlewire.web.desktop import open_browser, wanted_lan
    from turtlewire.web.lan import invite
    from turtlewire_view.graph.graph_page import GraphPage

    ended = threading.Event()
    signal.signal(signal.SIGTERM, lambda *_: ended.set())
    lan = args.lan or wanted_lan()
    with (
        contextlib.closing(wire.open_context()) as context,
        GraphPage(context, selection, port=args.port, lan=lan) as page,
    ):
        if args.port and args.port != urlsplit(page.url).port:
            print(f"Port {args.port} is in use: the graph uses a free port", flush=True)
        print(f"The graph is at {page.url} (Ctrl-C ends it)", flush=True)
        if lan:
            invite(page.url, print)
        open_browser(page.url)
        ended.wait()
    return 0
