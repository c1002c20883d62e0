"""`turtlewire trajectory`: shows, draws and converts the path of a frame."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy as np

from turtlewire.cli.trajectory_sources import TrajectoryReader, TrajectorySource, printed_remarks
from turtlewire.terminal.parser import tf_topics
from turtlewire.terminal.printable import printable
from turtlewire.trajectory.files import kitti_times, write_file
from turtlewire.trajectory.plots import runs_of
from turtlewire.wording import counted

if TYPE_CHECKING:
    import argparse

    from turtlewire.trajectory import Trajectory

_MOST_GAPS = 10


@printed_remarks()
def run_trajectory(args: argparse.Namespace) -> int:
    """Read a trajectory, write what was asked for, and print what it is like.

    Raises:
        BagError: The file is not a bag, or has no such topic.
        OSError: A file cannot be read or written.
        TransformException: The frames are unknown or not connected.
        ValueError: The file is not a trajectory, or nothing moves.
    """
    source = TrajectorySource(args.file, tuple(args.names))
    max_gap_ns = None if args.max_gap is None else round(args.max_gap * 1e9)
    reader = TrajectoryReader(*tf_topics(args), max_gap_ns)
    trajectory = reader.read(source, rate_hz=args.rate)
    written = []
    if args.output:
        kind = write_file(trajectory.stamps_ns, trajectory.poses, args.output, args.format)
        written.append(f"{args.output} ({kind})")
        if kind == "kitti":
            written.append(f"{kitti_times(args.output)} (the times)")
    if args.plot:
        trajectory.plot(args.kind or "path").save(args.plot)
        written.append(args.plot)
    if args.json:
        print(json.dumps(_figures(source, trajectory) | {"written": written}))
    else:
        print("\n".join(_lines(source, trajectory, written)))
    return 0


def _figures(source: TrajectorySource, trajectory: Trajectory) -> dict[str, object]:
    # Without times, the stamps only number the poses.
    stamps = trajectory.stamps_ns[: len(trajectory) if trajectory.timed else 0]
    runs = runs_of(trajectory) if len(stamps) else []
    speeds = np.concatenate([[], *(trajectory.speeds[run.start : run.stop - 1] for run in runs)])
    return {
        "source": str(source),
        "frame": trajectory.target_frame,
        "child_frame": trajectory.source_frame,
        "poses": len(trajectory),
        "path_length": trajectory.path_length,
        "duration": trajectory.duration_ns / 1e9 if trajectory.timed else None,
        "start_ns": int(stamps[0]) if len(stamps) else None,
        "end_ns": int(stamps[-1]) if len(stamps) else None,
        "rate": (len(stamps) - 1) * 1e9 / trajectory.duration_ns if len(stamps) > 1 else None,
        "mean_speed": float(np.mean(speeds)) if len(speeds) else None,
        "max_speed": float(speeds.max()) if len(speeds) else None,
        "gaps": trajectory.gaps,
    }


def _lines(source: TrajectorySource, trajectory: Trajectory, written: list[str]) -> list[str]:
    what = printable(str(source))
    if trajectory.source_frame:
        what = printable(f"'{trajectory.source_frame}' in '{trajectory.target_frame}' ({source})")
    if not len(trajectory):
        return [f"{what}: no poses"]
    figures = _figures(source, trajectory)
    rows = {"poses": f"{len(trajectory):,}", "path": f"{trajectory.path_length:.3f} m"}
    if trajectory.timed:
        rows["duration"] = f"{trajectory.duration_ns / 1e9:.3f} s"
        rows["from"] = f"{trajectory.stamps_ns[0] / 1e9:.6f} s"
        rows["to"] = f"{trajectory.stamps_ns[-1] / 1e9:.6f} s"
    else:
        rows["times"] = f"none; those of KITTI are read from {printable(kitti_times(source.path))}"
    if trajectory.timed and len(trajectory) > 1:
        rows["rate"] = f"{figures['rate']:.1f} Hz"
    if figures["mean_speed"] is not None:
        rows["speed"] = f"{figures['mean_speed']:.3f} m/s, at most {figures['max_speed']:.3f} m/s"
    lines = [what, *(f"  {name:9} {value}" for name, value in rows.items())]
    for gap in trajectory.gaps[:_MOST_GAPS]:
        pause = (gap.end_ns - gap.start_ns) / 1e9
        lines.append(f"  gap       {pause:.3f} s from {gap.start_ns / 1e9:.6f} s: no poses")
    if len(trajectory.gaps) > _MOST_GAPS:
        lines.append(f"  and {counted(len(trajectory.gaps) - _MOST_GAPS, 'more gap')}")
    return lines + [f"  written   {name}" for name in written]
