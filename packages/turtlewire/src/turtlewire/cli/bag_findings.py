"""Problems of a bag and its transforms, which the doctor finds without a network."""

from __future__ import annotations

import os
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire.bag import open_bag
from turtlewire.bag.metadata import not_in_cdr
from turtlewire.bag.transforms import fill_buffer
from turtlewire.doctor.finding import Finding, note, problem
from turtlewire.doctor.tf_findings import recorded_findings
from turtlewire.doctor.tf_traffic import FASTEST_M_S, JITTER_NS, LEAP_M, TfTraffic
from turtlewire.errors import BagError, CdrError
from turtlewire.tf.buffer import Buffer
from turtlewire.tf.tf_topics import as_options
from turtlewire.wire.qos import Durability
from turtlewire.wording import counted

if TYPE_CHECKING:
    from turtlewire.bag import Bag, TransformReport

_REINDEX = "`ros2 bag reindex {}` writes metadata.yaml; the intact files are read without it."
_INTACT = "The intact part was read. Copy the file again"
_NOT_CDR = "turtlewire.bag reads their bytes; to decode them, use the program that wrote the file."
_NO_TF = "Record /tf and /tf_static."
_OTHER_TF = "To examine them: turtlewire doctor {} {}"
_TF_TYPE = "tf2_msgs/msg/TFMessage"
_LATCH = (
    "Its publisher is not transient_local, so late listeners, and the recorder, may miss "
    "transforms: use a StaticTransformBroadcaster."
)
_REMEDIES = {
    "two publishers": "A frame must have one publisher: stop the others.",
    "two parents": "A frame has one parent at a time; lookups fail or jump. Rename one of the "
    "frames.",
    "loop": "Lookups to frames outside of the loop fail.",
}
_REFUSED = "Fix the node that publishes them; listeners ignore such transforms."
_NEW_PARENT = (
    "This is fine if a part changes hands (picked up by a gripper); otherwise rename one of the "
    "frames."
)
_PART = "Examine the whole bag, with its static transforms: turtlewire doctor {}"
_GAP = "Lookups within a gap interpolate across it; trajectories leave it out."
_FOREIGN = "Another type is published on the topic, or the recorder was cut off."


def examine_bag(
    path: str,
    topics: str | list[str] = "/tf",
    static_topics: str | list[str] = "/tf_static",
) -> list[Finding]:
    """Examine a bag and its transforms.

    Args:
        path: The bag.
        topics: The topics of the moving transforms.
        static_topics: The topics of the static transforms.

    Raises:
        BagError: ``path`` is not a bag.
        OSError: A file cannot be read.
    """
    found = []
    moving, fixed = _names(topics), _names(static_topics)
    with open_bag(path) as bag:
        end_ns = bag.end_ns
        found += _bag_findings(bag, path, fixed)
        if foreign := not_in_cdr(bag.topics.values()):
            found.append(note(foreign, _NOT_CDR))
        found += _other_transforms(bag, path, {*moving, *fixed})
        damage: list[BagError] = []
        bag.readable_files(bag.metadata.paths, damage)
        hints = {str(error): error.hint for error in damage}
        if (topics, static_topics) == ("/tf", "/tf_static") and not _has_tf(bag):
            found += [
                problem(text, hints.get(text) or _remedy_of_damage(path)) for text in bag.problems
            ]
            if not _tf_topics(bag):
                found.append(note("The bag has no transforms.", _NO_TF))
            return found
    try:
        buffer = Buffer(cache_time_ns=None)
        report = fill_buffer(buffer, path, topics=topics, static_topics=static_topics)
    except BagError as error:
        return [*found, problem(str(error), error.hint)]
    found += [problem(text, hints.get(text) or _remedy_of_damage(path)) for text in report.problems]
    traffic = _traffic(buffer, report, end_ns)
    traffic.written = {name: set() for name in _written_names(path, [*moving, *fixed])}
    return [*found, *_report_findings(report), *recorded_findings(traffic)]


def _names(topics: str | list[str]) -> list[str]:
    return [topics] if isinstance(topics, str) else topics


def _has_tf(bag: Bag) -> bool:
    return not {"/tf", "/tf_static"}.isdisjoint(bag.topics)


def _tf_topics(bag: Bag) -> list[str]:
    return sorted(name for name, topic in bag.topics.items() if topic.type == _TF_TYPE)


def _other_transforms(bag: Bag, path: str, read: set[str]) -> list[Finding]:
    """Return a note of the topics whose transforms are not examined, and the options for them."""
    others = [name for name in _tf_topics(bag) if name not in read]
    if not others:
        return []
    options = as_options(others)
    text = f"The bag has transforms on {', '.join(others)}, which are not examined."
    return [note(text, _OTHER_TF.format(path, options))]


def _remedy_of_damage(path: str) -> str:
    """Return what to do about damage; files of ROS 1 cannot be repaired."""
    if path.endswith(".bag"):
        return f"{_INTACT}."
    return f"{_INTACT}; or `ros2 bag reindex FOLDER` makes a file that was cut off whole."


def _bag_findings(bag: Bag, path: str, fixed: list[str]) -> list[Finding]:
    found = []
    if os.path.isdir(path) and not os.path.exists(os.path.join(path, "metadata.yaml")):
        found.append(note("The bag has no metadata.yaml.", _REINDEX.format(path)))
    if bag.part_of:
        text = f"{os.path.basename(path)} is one of several files of the bag {bag.part_of}."
        found.append(note(text, _PART.format(bag.part_of)))
    for name in fixed:
        offered = bag.topics[name].qos if name in bag.topics else []
        if any(qos.durability == Durability.VOLATILE for qos in offered):
            found.append(problem(f"{name} was published as volatile.", _LATCH))
    return found


def _report_findings(report: TransformReport) -> list[Finding]:
    found = []
    if report.malformed is not None and report.malformed.messages:
        count, last, topic = report.malformed
        text = f"Not a TFMessage: {counted(count, 'message')} of {topic}: {last}."
        found.append(problem(text, _FOREIGN))
    found += [problem(each.text, _REMEDIES[each.kind]) for each in report.conflicts]
    for child, before, after, stamp_ns in report.new_parents:
        text = f"'{child}' leaves its parent '{before}' for '{after}' at {stamp_ns / 1e9:.3f} s."
        found.append(note(text, _NEW_PARENT))
    for child, refused in report.refused.items():
        counts = ", ".join(f"{count} {reason}" for reason, count in refused.counts.items())
        found.append(problem(f"Transforms of '{child}' are rejected: {counts}.", _REFUSED))
    for child, gaps in report.gaps.items():
        longest = max(gap.end_ns - gap.start_ns for gap in gaps) / 1e9
        times = "once" if len(gaps) == 1 else f"{len(gaps)} times"
        text = f"'{child}' pauses {times}, for up to {longest:.3f} s."
        found.append(note(text, _GAP))
    return found


def _written_names(path: str, wanted: list[str]) -> set[str]:
    """Return the names of frames with a leading slash, and the same names without it.

    The buffer does not keep the slash. Messages are searched for the bytes before it: the length of
    a short string in little-endian CDR. Only the messages that have them are decoded.
    """
    names: set[str] = set()
    with open_bag(path) as bag, suppress(BagError):  # the report has the damage
        topics = [topic for topic in wanted if topic in bag.topics]
        for message in bag.messages(topics):
            if b"\0\0\0/" in message.data:
                with suppress(CdrError):
                    names |= _names_in(message.decode())
    plain = {name[1:] for name in names if name.startswith("/")} - names
    if plain:
        with open_bag(path) as bag, suppress(BagError):
            for message in bag.messages(topics):
                names |= {name for name in plain if b"\0\0\0%b\0" % name.encode() in message.data}
    return names


def _names_in(message: Any) -> set[str]:
    transforms = message.transforms
    return {name for each in transforms for name in (each.header.frame_id, each.child_frame_id)}


def _traffic(buffer: Buffer, report: TransformReport, end_ns: int) -> TfTraffic:
    """Return the traffic that a listener would have noted."""
    traffic = TfTraffic()
    traffic.ended_ns = end_ns
    for link in report.links:
        traffic.parents[link.child_frame] = {link.parent_frame}
        if not link.static:
            traffic.newest_ns[link.child_frame] = link.newest_ns
            leap = _largest_leap(buffer, link.child_frame)
            if leap:
                traffic.leaps_m[link.child_frame] = leap
    traffic.back_ns = {
        child: steps.largest_ns
        for child, steps in report.steps_back.items()
        if steps.largest_ns > JITTER_NS
    }
    return traffic


def _largest_leap(buffer: Buffer, child: str) -> float:
    """Return the largest step within one parent that was faster than any robot, in metres."""
    largest = 0.0
    for _, stamps, poses in buffer.samples(child):
        steps = np.linalg.norm(np.diff(poses[:, :3], axis=0), axis=1)
        allowed = np.maximum(LEAP_M, FASTEST_M_S * np.diff(stamps) / 1e9)
        leaps = steps[steps > allowed]
        largest = max(largest, float(leaps.max(initial=0.0)))
    return largest
