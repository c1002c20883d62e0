"""The parsers of `turtlewire bag`, `trajectory` and `compare`.

The commands import their code only when they run, because NumPy is slow to import.
"""

from __future__ import annotations

import argparse
import math
import shlex
from pathlib import Path
from typing import Any

from turtlewire.cli.bag_edit_parsers import add_bag_edits
from turtlewire.terminal.parser import (
    add_tf_topics,
    complete_bags,
    complete_files,
    reporting_errors,
    seconds,
    tf_topics,
)

_FORMATS = ("tum", "kitti", "euroc", "csv")
_ALIGNMENTS = ("none", "origin", "yaw", "se3", "sim3")
_RELATIONS = (
    "trans_part",
    "rot_part",
    "full",
    "angle_rad",
    "angle_deg",
    "point_distance",
    "point_distance_error_ratio",
)
#: Stamps of today plus this many seconds still fit into 64 bits of nanoseconds.
_TOO_LARGE_S = 4e9
_SOURCES = (
    "A trajectory is a file (TUM, KITTI, EuRoC, CSV), a bag's topic BAG:/topic (odometry or poses) "
    "or BAG:target:source (transforms, looked up at the reference's stamps)."
)


def add_bag_commands(commands: Any) -> None:
    """Add `bag`, `trajectory` and `compare` to the commands of `turtlewire`."""
    _add_bag(commands)
    _add_trajectory(commands)
    _add_compare(commands)


def _add_bag(commands: Any) -> None:
    summary = "Examine, cut, filter, merge and split bags"
    parser = commands.add_parser("bag", help=summary, description=summary)
    parser.set_defaults(run=lambda _: parser.print_help() or 0, parser=parser)
    parser.meant = what_to_do_with_bag
    verbs = parser.add_subparsers(
        title="Commands",
        description="Call `turtlewire bag COMMAND -h` for more detailed usage.",
        metavar="COMMAND",
    )
    add_bag_edits(verbs)
    summary = "Show the frame tree of a bag: rates, times, gaps and problems"
    tf = verbs.add_parser("tf", help=summary, description=summary)
    _add_file(tf, "file", "BAG", "A folder, a .mcap or a .db3 file")
    add_tf_topics(tf)
    tf.add_argument("--json", action="store_true", help="Print one JSON object")
    tf.set_defaults(run=reporting_errors("bag tf", _bag_tf), parser=tf)


def _add_trajectory(commands: Any) -> None:
    summary = "Show, draw and convert the path of a frame"
    parser = commands.add_parser("trajectory", help=summary, description=summary)
    _add_file(parser, "file", "FILE", "A bag, or a file with a trajectory (TUM, KITTI, EuRoC, CSV)")
    names = parser.add_argument(
        "names",
        nargs="*",
        metavar="NAME",
        help="For a bag: a topic with odometry or poses, or a target and a source frame",
    )
    names.completer = _complete_names
    output = parser.add_argument("-o", "--output", metavar="FILE", help="Write the trajectory")
    output.completer = complete_files
    parser.add_argument(
        "--format",
        choices=_FORMATS,
        help="Format of the output (default: from the file name, else tum)",
    )
    parser.add_argument(
        "--rate",
        type=_positive,
        metavar="HZ",
        help="Look transforms up at this rate (default: at the stamps of their samples)",
    )
    parser.add_argument(
        "--max-gap",
        type=seconds,
        metavar="S",
        help="Shortest pause that counts as a gap (default: ten times the median pause, at least "
        "0.5)",
    )
    add_tf_topics(parser)
    _add_plot(parser, ("path", "positions", "angles", "speeds"), "path")
    parser.add_argument("--json", action="store_true", help="Print one JSON object")
    run = reporting_errors("trajectory", _trajectory)
    parser.set_defaults(run=run, parser=parser)


def _add_compare(commands: Any) -> None:
    summary = "Compare trajectories with a reference: absolute and relative pose errors"
    parser = commands.add_parser(
        "compare", help=summary, description=f"{summary}.", epilog=_SOURCES
    )
    _add_file(parser, "reference", "REFERENCE", "The reference, for example ground truth")
    _add_file(
        parser, "estimates", "ESTIMATE", "Trajectories to compare with the reference", nargs="+"
    )
    parser.add_argument(
        "--align",
        choices=_ALIGNMENTS,
        default="none",
        help="How to align each estimate with the reference (default: %(default)s)",
    )
    parser.add_argument(
        "--poses-to-align", type=int, metavar="N", help="Align by the first N poses (default: all)"
    )
    parser.add_argument(
        "--relation",
        choices=_RELATIONS,
        default="trans_part",
        help="Pose relation to evaluate (default: %(default)s)",
    )
    _add_pairing(parser)
    add_tf_topics(parser)
    kinds = ("path", "error-path", "errors", "box", "histogram")
    _add_plot(parser, kinds, "error-path; path for several estimates")
    parser.add_argument(
        "--plane", default="xy", metavar="AXES", help="Axes of path plots (default: %(default)s)"
    )
    parser.add_argument("--json", action="store_true", help="Print a JSON list")
    parser.set_defaults(run=reporting_errors("compare", _compare), parser=parser)


def _add_pairing(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--delta",
        type=_positive,
        default=1,
        metavar="D",
        help="Distance between the two poses of a pair, for the relative error (default: "
        "%(default)s)",
    )
    parser.add_argument(
        "--delta-unit",
        choices=("f", "m", "d", "r"),
        default="f",
        help="Unit of --delta: frames, metres, degrees or radians (default: %(default)s)",
    )
    parser.add_argument(
        "--all-pairs", action="store_true", help="Start a pair at every pose (overlapping pairs)"
    )
    parser.add_argument(
        "--max-diff",
        type=seconds,
        default=0.01,
        metavar="S",
        help="Largest difference between paired stamps, in seconds (default: %(default)s)",
    )
    parser.add_argument(
        "--offset",
        type=_offset,
        default=0.0,
        metavar="S",
        help="Seconds to add to the stamps of the estimates (default: %(default)s)",
    )


def _add_plot(parser: Any, kinds: tuple[str, ...], default: str) -> None:
    plot = parser.add_argument("--plot", metavar="FILE", help="Save a plot: .svg, .pdf or .png")
    plot.completer = complete_files
    parser.add_argument("--kind", choices=kinds, help=f"Kind of plot (default: {default})")


def _add_file(parser: Any, name: str, metavar: str, text: str, nargs: str | None = None) -> None:
    argument = parser.add_argument(name, metavar=metavar, help=text, nargs=nargs)
    argument.completer = complete_bags if metavar == "BAG" else complete_files


def what_to_do_with_bag(path: str) -> str:
    """Return the commands that show a bag; an empty string if it is not a bag."""
    if not _is_bag(Path(path)):
        return ""
    bag = shlex.quote(path)
    return (
        f"{path} is a bag. Its transforms: turtlewire bag tf {bag}; what is in it: "
        f"turtlewire bag info {bag}; in 3D: turtlewire view {bag}"
    )


def _is_bag(path: Path) -> bool:
    """Return True for a bag: a folder named like a frame does not count."""
    try:
        files = list(path.iterdir()) if path.is_dir() else [path] if path.is_file() else []
    except OSError:
        return False
    return any(
        file.name.removesuffix(".zstd").endswith((".mcap", ".db3", ".bag")) for file in files
    )


def _complete_names(parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    from turtlewire.cli.trajectory_sources import complete_names
    from turtlewire.errors import BagError

    try:
        return complete_names(parsed_args.file)
    except (BagError, OSError):
        return []


def _positive(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number above 0")
    return value


def _offset(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not abs(value) < _TOO_LARGE_S:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of seconds")
    return value


def _bag_tf(args: argparse.Namespace) -> int:
    from turtlewire.cli.bag_tf import show_transforms

    print(show_transforms(args.file, *tf_topics(args), as_json=args.json))
    return 0


def _trajectory(args: argparse.Namespace) -> int:
    from turtlewire.cli.trajectory_command import run_trajectory

    if len(args.names) > 2:
        args.parser.error(f"expected a topic or two frames, got {len(args.names)} names")
    if (args.topic or args.static_topic) and len(args.names) != 2:
        args.parser.error("--topic and --static-topic need two frames")
    if args.rate is not None and len(args.names) != 2:
        args.parser.error("--rate needs two frames; other poses are not interpolated")
    if args.format and not args.output:
        args.parser.error("--format needs --output")
    _check_kind(args)
    return run_trajectory(args)


def _compare(args: argparse.Namespace) -> int:
    from turtlewire.cli.compare_command import run_compare

    _check_kind(args)
    if args.poses_to_align is not None and args.align == "none":
        args.parser.error("--poses-to-align needs --align")
    return run_compare(args)


def _check_kind(args: argparse.Namespace) -> None:
    if args.kind and not args.plot:
        args.parser.error("--kind needs --plot")
