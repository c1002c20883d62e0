"""Writes bags as a LeRobot data set: each bag becomes an episode."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from aligned import Wanted, align
from dataset import DataSet
from images import images_of

from turtlewire.bag import open_bag
from turtlewire.errors import TurtlewireError
from turtlewire.program import program


def parsed(words: list[str] | None) -> argparse.Namespace:
    """Return the arguments of the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    add = parser.add_argument
    add("bags", nargs="+", metavar="BAG", help="a bag; each becomes an episode")
    add("-o", "--output", required=True, type=Path, metavar="FOLDER", help="the data set to write")
    add("--fps", type=int, default=10, help="rows and images a second (default: 10)")
    add("--joints", default="/joint_states", metavar="TOPIC", help="'' for no joint states")
    add(
        "--pose",
        action="append",
        default=[],
        metavar="TARGET:SOURCE",
        help="add the pose of SOURCE in TARGET to the state",
    )
    add("--action", required=True, metavar="TOPIC:FIELD[,FIELD]", help="the commands")
    add("--camera", action="append", default=[], metavar="NAME=TOPIC", help="add a camera")
    add("--nearest", action="store_true", help="take the nearest image, not the latest one")
    add("--task", default="", help="what the robot does, in words")
    add("--robot", default="robot", help="the type of the robot (default: robot)")
    return parser.parse_args(words)


def wanted_parts(arguments: argparse.Namespace) -> Wanted:
    """Return the parts of a row; ValueError if an argument has another form."""
    action, _, fields = arguments.action.partition(":")
    poses = [tuple(pose.split(":")) for pose in arguments.pose]
    cameras = [camera.split("=") for camera in arguments.camera]
    for given, form in ((poses, "--pose TARGET:SOURCE"), (cameras, "--camera NAME=TOPIC")):
        if any(len(parts) != 2 or not all(parts) for parts in given):
            raise ValueError(f"expected {form}")
    if any("/" in name for name, _ in cameras):
        raise ValueError("LeRobot allows no / in the name of a camera")
    if not fields:
        raise ValueError(f"name the fields of {action}, such as --action {action}:data")
    if arguments.fps < 1:
        raise ValueError(f"expected at least 1 row a second, got --fps {arguments.fps}")
    if not arguments.joints and not poses:
        raise ValueError("the state is empty: name --joints or a --pose")
    return Wanted(
        arguments.fps,
        arguments.joints,
        action,
        fields.split(","),
        poses,
        dict(cameras),
        arguments.nearest,
    )


def convert(arguments: argparse.Namespace) -> None:
    """Write the data set."""
    wanted = wanted_parts(arguments)
    with DataSet(arguments.output, wanted.fps, arguments.robot) as data_set:
        for path in arguments.bags:
            with open_bag(path) as bag:
                rows = align(bag, wanted)
                images = {
                    name: images_of(bag, topic, rows.images[name])
                    for name, topic in wanted.cameras.items()
                }
                data_set.add_episode(rows, arguments.task, images)
            seconds = (rows.stamps_ns[-1] - rows.stamps_ns[0]) / 1e9
            print(f"{path}: {len(rows.stamps_ns)} rows, {seconds:.1f} s")


@program
def main(words: list[str] | None = None) -> int:
    """Convert the bags that the command line names."""
    try:
        convert(parsed(words))
    except (OSError, TurtlewireError, ValueError) as error:
        print(error, file=sys.stderr)
        if hint := getattr(error, "hint", ""):
            print(hint, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
