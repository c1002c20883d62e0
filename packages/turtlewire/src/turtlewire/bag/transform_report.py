"""Statistics and problems of the transforms of a bag."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.terminal.printable import printable, table_lines
from turtlewire.tf.faults import Conflict, conflicts, malformed, refusals
from turtlewire.tf.links import links
from turtlewire.trajectory.stamps import find_gaps
from turtlewire.wording import counted

if TYPE_CHECKING:
    from turtlewire.tf.faults import Malformed, Refused
    from turtlewire.tf.implementation import BaseBuffer
    from turtlewire.tf.links import Link
    from turtlewire.trajectory import Gap

__all__ = ["Jump", "NewParent", "StepsBack", "TransformReport", "describe", "group_jumps"]

_MOST_SHOWN = 5


class Jump(NamedTuple):
    """Stamps that fall back by more than a second, as where a bag starts again in a loop.

    Attributes:
        log_time_ns: When the first message with an earlier stamp was received.
        back_ns: By how much the stamps fall back, at most.
        frames: The child frames whose stamps fall back.
    """

    log_time_ns: int
    back_ns: int
    frames: tuple[str, ...]


class StepsBack(NamedTuple):
    """Stamps of a frame that lie before one that came earlier, jumps included.

    Attributes:
        times: How many.
        largest_ns: How far the largest step goes.
    """

    times: int
    largest_ns: int


class NewParent(NamedTuple):
    """A frame that leaves its parent for another one.

    Attributes:
        child_frame: The frame.
        before: Its parent up to then.
        after: Its parent from then on.
        stamp_ns: The stamp of the first sample with the new parent.
    """

    child_frame: str
    before: str
    after: str
    stamp_ns: int


@dataclass(repr=False)
class TransformReport:
    """The transforms of a bag. Printed, it is a table of links and a list of problems.

    Attributes:
        name: Name of the bag.
        messages: Messages that were read.
        publishers: By topic, how many publishers the recorder noted.
        links: Each link with its rate, times and senders (the topics).
        gaps: Pauses in the samples of links, by child frame.
        jumps: Where stamps fall back by more than a second.
        steps_back: Stamps that step back, by child frame.
        new_parents: Changes of parents to which the frame does not come back, as when a gripper
            takes a part.
        conflicts: Frames that go back and forth between parents, or come on two topics.
        refused: Transforms that tf2 refuses, by child frame.
        malformed: Messages that are no ``TFMessage``.
        problems: Damaged or missing parts of the bag.
        part_of: The folder of the bag, if one of its several files was opened alone.
    """

    name: str = ""
    messages: int = 0
    publishers: dict[str, int] = field(default_factory=dict)
    links: list[Link] = field(default_factory=list)
    gaps: dict[str, list[Gap]] = field(default_factory=dict)
    jumps: list[Jump] = field(default_factory=list)
    steps_back: dict[str, StepsBack] = field(default_factory=dict)
    new_parents: list[NewParent] = field(default_factory=list)
    conflicts: list[Conflict] = field(default_factory=list)
    refused: dict[str, Refused] = field(default_factory=dict)
    malformed: Malformed | None = None
    problems: list[str] = field(default_factory=list)
    part_of: str = ""

    @property
    def two_parents(self) -> list[str]:
        """The frames with more than one parent, whether they change it once or often."""
        often = [each.child_frame for each in self.conflicts if each.kind == "two parents"]
        return often + list(dict.fromkeys(each.child_frame for each in self.new_parents))

    def complaints(self) -> list[str]:
        """Return the problems, one line each."""
        lines = [f"problem: {text}" for text in self.problems]
        if self.part_of:
            lines.append(
                f"part: {self.name} is one of several files of a bag; open {self.part_of} for all "
                "of it, static transforms too"
            )
        if self.malformed is not None and self.malformed.messages:
            count = counted(self.malformed.messages, "message")
            lines.append(f"no TFMessage: {count}: {self.malformed.last}")
        lines += [f"{each.kind}: {each.text}" for each in self.conflicts]
        lines += [_parent_line(each) for each in self.new_parents]
        lines += _jump_lines(self.jumps)
        lines += [_steps_line(child, steps) for child, steps in self._steps_without_jumps()]
        lines += [_gap_line(child, gaps) for child, gaps in self.gaps.items()]
        lines += [_refused_line(child, refused) for child, refused in self.refused.items()]
        return [printable(line) for line in lines]

    def _steps_without_jumps(self) -> list[tuple[str, StepsBack]]:
        """Return the frames that step back in other ways than by their jumps."""
        jumps = Counter(child for jump in self.jumps for child in jump.frames)
        return [each for each in self.steps_back.items() if each[1].times > jumps[each[0]]]

    def headline(self) -> str:
        """Return a one-line summary."""
        topics = ", ".join(f"{topic} ({_publishers(n)})" for topic, n in self.publishers.items())
        return printable(f"{self.name}: {counted(self.messages, 'message')} of {topics}")

    def __repr__(self) -> str:
        return "\n".join((self.headline(), *_table(self.links), *self.complaints()))


def describe(buffer: BaseBuffer, report: TransformReport) -> None:
    """Add the statistics of the filled buffer to the report."""
    report.links = links(buffer)
    report.conflicts = conflicts(buffer)
    often = set(report.two_parents)
    report.refused = refusals(buffer)
    report.malformed = malformed(buffer)
    for link in report.links:
        if link.child_frame not in often:
            _note_parents(buffer, report, link)
        if link.static or link.samples < 3:
            continue
        if found := find_gaps(buffer._stamps(link.child_frame)):
            report.gaps[link.child_frame] = found


def _note_parents(buffer: BaseBuffer, report: TransformReport, link: Link) -> None:
    """Add the changes of a frame's parent, or that it is static in one and moves in another."""
    child = link.child_frame
    if link.parent_changes:
        for (before, *_), (after, stamps, _) in pairwise(buffer.samples(child)):
            report.new_parents.append(NewParent(child, before, after, int(stamps[0])))
        return
    parents = sorted({sender.parent_frame for sender in link.senders})
    if len(parents) > 1:
        text = f"'{child}' is sent with the parents {' and '.join(map(repr, parents))}"
        found = Conflict("two parents", child, f"{text}, moving and static; a frame has one.")
        report.conflicts.append(found)


def group_jumps(jumps: list[tuple[int, str, int]]) -> list[Jump]:
    """Merge the jumps of frames that fall back together.

    Args:
        jumps: Log time, child frame and how far back, of each frame, in the order of the file.
    """
    grouped: list[Jump] = []
    for log_time, child, back in jumps:
        if grouped and child not in grouped[-1].frames:
            last = grouped[-1]
            grouped[-1] = Jump(last.log_time_ns, max(last.back_ns, back), (*last.frames, child))
        else:
            grouped.append(Jump(log_time, back, (child,)))
    return grouped


def _publishers(count: int) -> str:
    if not count:  # older recorders do not store the QoS
        return "publishers unknown"
    return counted(count, "publisher")


def _table(links: list[Link]) -> list[str]:
    rows = [("child", "parent", "rate", "samples", "from", "to")]
    for link in links:
        times = ("", "") if link.static else (_seconds(link.oldest_ns), _seconds(link.newest_ns))
        rate = "static" if link.static else f"{link.rate_hz:.1f} Hz"
        samples = "" if link.static else f"{link.samples:,}"
        names = printable(link.child_frame), printable(link.parent_frame)
        rows.append((*names, rate, samples, *times))
    return [f"  {line}" for line in table_lines(rows, left=(0, 1))]


def _seconds(stamp_ns: int) -> str:
    seconds, nanoseconds = divmod(stamp_ns, 1_000_000_000)
    return f"{seconds}.{nanoseconds:09d}"


def _jump_lines(jumps: list[Jump]) -> list[str]:
    """Return a line for each of the first jumps, and one for all the others."""
    lines = [_jump_line(jump) for jump in jumps[:_MOST_SHOWN]]
    if rest := jumps[_MOST_SHOWN:]:
        largest = max(jump.back_ns for jump in rest) / 1e9
        lines.append(f"jump of time: and {len(rest):,} more, by up to {largest:.3f} s")
    return lines


def _jump_line(jump: Jump) -> str:
    frames = _some(jump.frames)
    return (
        f"jump of time: at {_seconds(jump.log_time_ns)} the stamps of {frames} fall back by "
        f"{jump.back_ns / 1e9:.3f} s"
    )


def _parent_line(change: NewParent) -> str:
    return (
        f"new parent: '{change.child_frame}' leaves '{change.before}' for '{change.after}' at "
        f"{_seconds(change.stamp_ns)}"
    )


def _steps_line(child: str, steps: StepsBack) -> str:
    times = "once" if steps.times == 1 else f"{steps.times:,} times"
    largest = steps.largest_ns / 1e6
    return f"out of order: the stamps of '{child}' step back {times}, by up to {largest:.6g} ms"


def _gap_line(child: str, gaps: list[Gap]) -> str:
    shown = [
        f"{(gap.end_ns - gap.start_ns) / 1e9:.3f} s from {_seconds(gap.start_ns)}" for gap in gaps
    ]
    return f"gap: '{child}' pauses for {_some(shown)}"


def _refused_line(child: str, refused: Refused) -> str:
    counts = ", ".join(f"{count} {reason}" for reason, count in refused.counts.items())
    return f"rejected: transforms of '{child}': {counts}"


def _some(texts: tuple[str, ...] | list[str]) -> str:
    rest = len(texts) - _MOST_SHOWN
    return ", ".join(texts[:_MOST_SHOWN]) + (f" and {rest} more" if rest > 0 else "")
