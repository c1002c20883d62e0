"""`turtlewire compare`: APE and RPE of estimates against a reference."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any

from turtlewire.cli.trajectory_sources import TrajectoryReader, parse_source, printed_remarks
from turtlewire.terminal.parser import tf_topics
from turtlewire.terminal.printable import printable
from turtlewire.trajectory import compare, plot
from turtlewire.trajectory.metrics import distance_text
from turtlewire.trajectory.plots import columns_of
from turtlewire.wording import counted

if TYPE_CHECKING:
    import argparse

    from turtlewire.trajectory import Comparison, Plot, PoseErrors


@printed_remarks()
def run_compare(args: argparse.Namespace) -> int:
    """Compare, draw what was asked for, and print the statistics.

    Raises:
        BagError: A source is not a bag, or has no such topic.
        OSError: A file cannot be read or written.
        TransformException: Frames are unknown or not connected.
        ValueError: No stamps match, or the alignment is not possible.
    """
    columns_of(args.plane)  # report an invalid one even if it is not drawn
    reader = TrajectoryReader(*tf_topics(args))
    reference = reader.read(parse_source(args.reference))
    compared: dict[str, Comparison] = {}
    poses: dict[str, tuple[int, int]] = {}
    for text in args.estimates:
        name = str(parse_source(text))
        estimate = reader.read(parse_source(text), like=reference)
        poses[name] = (len(reference), len(estimate))
        try:
            compared[name] = compare(
                reference,
                estimate,
                args.align,
                max_diff_ns=round(args.max_diff * 1e9),
                offset_ns=round(args.offset * 1e9),
                poses_to_align=args.poses_to_align,
            )
        except ValueError as error:
            raise ValueError(f"{printable(name)}: {error}") from error
    if args.plot:
        _draw(args, compared).save(args.plot)
    if args.json:
        print(json.dumps([_figures(args, name, compared[name], poses[name]) for name in compared]))
    else:
        blocks = [_text(args, name, compared[name], poses[name]) for name in compared]
        print("\n".join(blocks), end="")
    return 0


def _ape(args: argparse.Namespace, comparison: Comparison) -> PoseErrors:
    # APE has no error ratio, so it uses the distance itself.
    ratio = args.relation == "point_distance_error_ratio"
    return comparison.ape("point_distance" if ratio else args.relation)


def _rpe(args: argparse.Namespace, comparison: Comparison) -> tuple[PoseErrors | None, str]:
    """Return the relative error; or None and the reason."""
    try:
        found = comparison.rpe(
            args.relation, delta=args.delta, unit=args.delta_unit, all_pairs=args.all_pairs
        )
    except ValueError as error:
        return None, str(error)
    return found, ""


def _figures(
    args: argparse.Namespace, name: str, comparison: Comparison, poses: tuple[int, int]
) -> dict[str, Any]:
    rpe, reason = _rpe(args, comparison)
    return {
        "reference": args.reference,
        "estimate": name,
        "pairs": len(comparison.reference),
        "reference_poses": poses[0],
        "estimate_poses": poses[1],
        "relation": args.relation,
        "align": comparison.align,
        "scale": comparison.alignment.scale,
        "rotation": comparison.alignment.rotation.tolist(),
        "translation": comparison.alignment.translation.tolist(),
        "ape": _ape(args, comparison).statistics._asdict(),
        "rpe": rpe.statistics._asdict() if rpe else None,
        "rpe_missing": reason or None,
    }


def _left_out(pairs: int, poses: tuple[int, int]) -> str:
    """Return a line about the poses that have no partner; nothing if all have one."""
    if poses == (pairs, pairs):
        return ""
    return (
        f"of {counted(poses[0], 'pose')} of the reference and {poses[1]:,} of the estimate; the "
        "others have no partner (gaps, ends, rates)\n"
    )


def _text(
    args: argparse.Namespace, name: str, comparison: Comparison, poses: tuple[int, int]
) -> str:
    scale = f", scale {comparison.alignment.scale:.6f}" if comparison.align == "sim3" else ""
    pairs = len(comparison.reference)
    head = (
        f"{printable(name)} against {printable(args.reference)}\n"
        f"{counted(pairs, 'pair')} of poses, aligned: {comparison.align}{scale}\n"
        f"{_left_out(pairs, poses)}"
    )
    ape, (rpe, reason) = _ape(args, comparison), _rpe(args, comparison)
    text = f"{head}\n{_title(ape)}\n{ape.table()}\n"
    if rpe is None:
        return f"{text}RPE {args.relation}: cannot be computed, {reason}\n"
    distance = distance_text(args.delta, args.delta_unit)
    return f"{text}{_title(rpe)} over {distance}\n{rpe.table()}"


def _title(errors: PoseErrors) -> str:
    return f"{errors.name} {errors.relation}" + (f" ({errors.unit})" if errors.unit else "")


def _draw(args: argparse.Namespace, compared: dict[str, Comparison]) -> Plot:
    kind: Any = args.kind or ("error-path" if len(compared) == 1 else "path")
    first = next(iter(compared.values()))
    if kind == "path":
        named = {_short(name): each.estimate for name, each in compared.items()}
        return plot(named, reference=first.reference, plane=args.plane)
    errors = {_short(name): _ape(args, each) for name, each in compared.items()}
    if kind in ("box", "histogram"):
        return plot(errors, kind)
    if len(compared) > 1:
        raise ValueError(f"'{kind}' shows one estimate; for several there are path, box, histogram")
    (only,) = errors.values()
    if kind == "errors":
        return first.plot("errors", relation=only.relation)
    return first.plot(relation=only.relation, plane=args.plane)


def _short(name: str) -> str:
    return os.path.basename(name) or name
