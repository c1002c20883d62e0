"""Problems of the published transforms, and gaps in periodic series: lost in transit, or skipped.

A broadcaster with a timer stamps its transforms one period apart. If some of them get lost, each at
random, the steps between the rest are multiples of that period, and their lengths follow the
geometric distribution. Three other patterns look different, and are not loss: a broadcaster that
has no period, one that is delayed from time to time (few but long gaps), and one whose clock ticks
faster than it publishes (all steps nearly as long).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from statistics import fmean, pvariance
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.doctor.finding import Finding, note, problem
from turtlewire.doctor.graph_findings import owner_of
from turtlewire.doctor.tf_traffic import tf_publishers
from turtlewire.tf.frame_tree import find_loops
from turtlewire.tf.tf_topics import as_options, of_first_robot, other_tf_topics
from turtlewire.wording import counted

if TYPE_CHECKING:
    from turtlewire.doctor.tf_traffic import TfTraffic
    from turtlewire.tf.tf_topics import TfTopics
    from turtlewire.wire.base import Graph

#: With fewer steps, random steps look periodic.
_FEWEST_STEPS = 10
#: Stamps of one moment: what a node publishes in one turn.
_ONE_MOMENT_NS = 1_000_000
#: Maximum length of the shortest remaining step, in periods.
_LONGEST_SHORTEST = 6
#: Tolerance of a step, as a fraction of the period; some steps may differ by more.
_TOLERANCE = 0.2
_MISFITS = 0.1
#: A smaller number means that the broadcaster was delayed for a moment.
_LEAST_SHARE = 0.3
#: Minimum fraction of what random loss leaves on average: single steps, gaps, and variance.
_MUCH = 0.4


class Gaps(NamedTuple):
    """The transforms that are missing from a series.

    Attributes:
        share: The part that is missing, 0 to 1.
        period_s: Time between two transforms, if none were missing [s].
        longest_s: The longest step between two transforms that came [s].
    """

    share: float
    period_s: float
    longest_s: float


def find_gaps(stamps_ns: Sequence[int]) -> Gaps | None:
    """Look for transforms that are missing.

    Args:
        stamps_ns: Stamps of a frame's transforms from one publisher [ns], in any order.

    Returns:
        What is missing; None if nothing is, or if the stamps have no rhythm.
    """
    steps = [
        later - earlier
        for earlier, later in pairwise(sorted(stamps_ns))
        if later - earlier > _ONE_MOMENT_NS
    ]
    if len(steps) < _FEWEST_STEPS:
        return None
    for divisor in range(1, _LONGEST_SHORTEST + 1):
        turns = _turns(steps, min(steps) / divisor)
        if turns is not None:
            break
    else:
        return None
    share = 1.0 - len(turns) / sum(turns)
    if share < _LEAST_SHARE or not _is_random(turns, share):
        return None
    return Gaps(share, sum(steps) / sum(turns) / 1e9, max(steps) / 1e9)


def _turns(steps: Sequence[int], period: float) -> list[int] | None:
    """Return each step in periods, shortest first; None if they are not multiples.

    The period is corrected with each step, so that it is good enough for the long ones.
    """
    turns: list[int] = []
    total = misfits = 0
    for step in sorted(steps):
        turn = max(1, round(step / period))
        misfits += abs(step / period - turn) > _TOLERANCE
        turns.append(turn)
        total += step
        period = total / sum(turns)
    return turns if misfits <= _MISFITS * len(steps) else None


def _is_random(turns: Sequence[int], share: float) -> bool:
    """Return True if random loss explains the number and the lengths of the gaps."""
    mean = fmean(turns)
    singles = sum(turn == 1 for turn in turns)
    gaps = len(turns) - singles
    return (
        singles >= int(_MUCH * (1.0 - share) * len(turns))
        and gaps >= _MUCH * share * len(turns)
        and pvariance(turns, mean) >= _MUCH * mean * (mean - 1.0)
    )


_STALE_NS = 2_000_000_000
_WALL_TIME_FROM_NS = 10**9 * 10**9  # the year 2001; simulated time begins at zero

_START_BROADCASTER = "Start a node with a TransformBroadcaster or a StaticTransformBroadcaster."
_EXAMINE_OTHERS = (
    "To examine one robot's: turtlewire doctor {}. Nodes that should see them need "
    "the same remappings, such as --ros-args -r /tf:=/robot1/tf."
)
_ONE_PUBLISHER = "A frame must have one publisher: stop the others."
_ONE_PARENT = "A frame has one parent at a time; lookups fail or jump. Rename one of the frames."
_JOIN_TREES = (
    "No lookup between them is possible: publish a transform from one root to the other "
    "(static_transform_publisher)."
)
_NO_LOOP = (
    "Lookups with these frames fail. One of the frames has the wrong parent: fix or stop the node "
    "that publishes it."
)
_ONE_CLOCK = "Set use_sim_time to the same value for all nodes."
_ENDED = (
    "Its publisher ended before the recording, or was slow, or the clocks of two hosts differed; "
    "it has no later poses."
)
_SLOW = "Its publisher is slow, or the clocks of two hosts differ (chrony or NTP sets them)."
_AHEAD = (
    "Lookups at the present time fail. Its publisher does not stamp with its node's clock, or that "
    "clock is ahead of this host's (chrony or NTP sets them)."
)
_SILENT = "Its transforms are not sent yet, or are lost in transit; their child frames are unknown."
_JUMPS = (
    "Two sources publish it, a bag restarted, or a clock was set: listeners drop such "
    "transforms, or clear their buffers."
)
_REFUSED = (
    "No listener takes them, and lookups with the frame fail or use older poses. Fix the node that "
    "publishes it."
)
_MISSING = (
    "They are lost in transit, or the publisher misses its period. Run `ros2 topic hz {}` here "
    "and on the publisher's host: if the rate is higher there, fix the network or the QoS; "
    "otherwise the publisher is too slow."
)
_NAMED = 3
_NO_SLASH = (
    "tf2 removes the slash of a received transform, so the names with and without it are one "
    "frame. It rejects lookups with the slash, also for a message whose header has it, and "
    "programs that compare names see two frames. "
)
_PUBLISH_WITHOUT = "Publish the names without a slash."
_RENAME = "Rename them: `turtlewire bag filter BAG -o NEW {}`."
_LEAPS = "Either it was moved to another position, or two sources disagree about where it is."


def tf_findings(graph: Graph, traffic: TfTraffic) -> list[Finding]:
    """Return the problems of the received transforms.

    Args:
        graph: The graph, which maps publishers to nodes.
        traffic: The received transforms.
    """
    if not tf_publishers(graph, traffic.topics):
        return [_nothing_published(graph, traffic.topics)]
    return [
        *_publisher_findings(graph, traffic),
        *_refusal_findings(traffic),
        *_tree_findings(traffic),
        *_slash_findings(traffic, graph),
        *_clock_findings(traffic),
        *_step_findings(traffic),
        *_gap_findings(traffic),
    ]


def _nothing_published(graph: Graph, topics: TfTopics) -> Finding:
    if others := other_tf_topics(graph, topics):
        text = f"No node publishes transforms on {topics}, but on {' and '.join(others)}."
        return note(text, _EXAMINE_OTHERS.format(as_options(of_first_robot(others))))
    return note("No node publishes transforms.", _START_BROADCASTER)


def recorded_findings(traffic: TfTraffic) -> list[Finding]:
    """Return the problems of a bag's transforms: its tree, clocks, and steps in time and space.

    Args:
        traffic: The recorded transforms; they end with the bag.
    """
    clocks = _clock_findings(traffic, recorded=True)
    slashes = _slash_findings(traffic)
    return [*_tree_findings(traffic), *slashes, *clocks, *_step_findings(traffic)]


def _publisher_findings(graph: Graph, traffic: TfTraffic) -> list[Finding]:
    found = []
    for child, gids in sorted(traffic.publishers.items()):
        if len(gids) > 1:
            nodes = " and ".join(_nodes(graph, gids))
            found.append(problem(f"The frame '{child}' is published by {nodes}.", _ONE_PUBLISHER))
    for publisher in tf_publishers(graph, traffic.topics):
        if publisher.topic == traffic.topics.static and publisher.gid not in traffic.heard:
            text = f"No static transforms received from {owner_of(publisher)}."
            found.append(note(text, _SILENT))
    return found


def _refusal_findings(traffic: TfTraffic) -> list[Finding]:
    return [
        problem(f"Transforms of '{frame}' are refused: {' '.join(reason.split())}.", _REFUSED)
        for frame, reason in traffic.refused.items()
    ]


def _nodes(graph: Graph, gids: set[bytes]) -> list[str]:
    """Return the name of the node of each publisher, sorted."""
    owners = {endpoint.gid: owner_of(endpoint) for endpoint in graph.endpoints()}
    return sorted(owners.get(gid, "an unknown node") for gid in gids)


def _quoted(frames: Iterable[str]) -> str:
    """Return the first names of frames, and the number of the others."""
    names = [f"'{frame}'" for frame in frames]
    if len(names) > _NAMED:
        names[_NAMED:] = [counted(len(names) - _NAMED, "other")]
    return " and ".join(names)


def _tree_findings(traffic: TfTraffic) -> list[Finding]:
    found = [
        problem(
            f"The frame '{child}' has several parents: {', '.join(sorted(parents))}.", _ONE_PARENT
        )
        for child, parents in sorted(traffic.parents.items())
        if len(parents) > 1
    ]
    only = {child: min(of) for child, of in sorted(traffic.parents.items()) if len(of) == 1}
    for loop in find_loops(only):
        path = " -> ".join((*loop, loop[0]))
        found.append(problem(f"The frames form a loop, from child to parent: {path}.", _NO_LOOP))
    parents = {parent for of_child in traffic.parents.values() for parent in of_child}
    roots = sorted(parents - traffic.parents.keys())
    if len(roots) > 1:
        text = f"The frames form {len(roots)} separate trees, with the roots {', '.join(roots)}."
        found.append(problem(text, _JOIN_TREES))
    return found


def _slash_findings(traffic: TfTraffic, graph: Graph | None = None) -> list[Finding]:
    """Return a note of frames with two names, and one of the others; a bag has no graph."""
    slashed = sorted(name for name in traffic.written if name.startswith("/"))
    twins = [name for name in slashed if name[1:] in traffic.written]
    others = [name for name in slashed if name not in twins]
    found = []
    for names, how in ((twins, "with and without"), (others, "with")):
        if not names:
            continue
        frames = "The frame {} is" if len(names) == 1 else "The frames {} are"
        text = frames.format(_quoted(name[1:] for name in names))
        text += f" published {how} a leading slash"
        options = (f"--rename-frame {name}:={name[1:]}" for name in names[:_NAMED])
        remedy = _RENAME.format(" ".join(options))
        if graph is not None:
            gids = {gid for name in names for gid in traffic.written[name]}
            text += f"; the slash is from {' and '.join(dict.fromkeys(_nodes(graph, gids)))}"
            remedy = _PUBLISH_WITHOUT
        found.append(note(f"{text}.", _NO_SLASH + remedy))
    return found


def _clock_findings(traffic: TfTraffic, *, recorded: bool = False) -> list[Finding]:
    wall = {child for child, stamp in traffic.newest_ns.items() if stamp >= _WALL_TIME_FROM_NS}
    simulated = traffic.newest_ns.keys() - wall
    found = []
    if wall and simulated:
        text = f"Wall time and simulated time are mixed: {min(wall)} and {min(simulated)}."
        found.append(problem(text, _ONE_CLOCK))
    for child, newest_ns in sorted(traffic.newest_ns.items()):
        now_ns = traffic.ended_ns if child in wall else traffic.clock_ns
        if now_ns is None:
            continue
        age_ns = now_ns - newest_ns
        if age_ns < -_STALE_NS and not recorded:
            text = f"The newest transform of '{child}' is {-age_ns / 1e9:.1f} s in the future."
            found.append(note(text, _AHEAD))
        elif age_ns > _STALE_NS:
            text = f"The newest transform of '{child}' is {age_ns / 1e9:.1f} s old"
            if recorded:
                found.append(note(f"{text} at the end of the bag.", _ENDED))
            else:
                found.append(note(f"{text}.", _SLOW))
    return found


def _step_findings(traffic: TfTraffic) -> list[Finding]:
    jumps = [
        problem(f"The stamps of '{child}' jump back, by up to {back_ns / 1e9:.3f} s.", _JUMPS)
        for child, back_ns in sorted(traffic.back_ns.items())
    ]
    leaps = [
        note(f"The frame '{child}' leaps by up to {leap_m:.1f} m between transforms.", _LEAPS)
        for child, leap_m in sorted(traffic.leaps_m.items())
    ]
    return jumps + leaps


def _gap_findings(traffic: TfTraffic) -> list[Finding]:
    """Return one note for all frames: a lossy network affects all of them."""
    found = {
        child: gaps
        for (child, _), stamps in sorted(traffic.stamps_ns.items())
        if (gaps := find_gaps(stamps)) is not None
    }
    if not found:
        return []
    worst = max(found.values())
    text = (
        f"About {worst.share:.0%} of the transforms of {_quoted(found)} are missing: "
        f"expected every {worst.period_s * 1e3:.0f} ms, longest gap {worst.longest_s:.2f} s."
    )
    return [note(text, _MISSING.format(traffic.topics.moving))]
