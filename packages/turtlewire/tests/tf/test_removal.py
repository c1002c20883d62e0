"""Removing frames: remaining data, and cost."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import pytest
from tests.programs import run_python

SECOND = 1_000_000_000
POSE = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))


def test_a_frame_that_comes_back_stands_last(core: Any) -> None:
    buffer = core.Buffer()
    for child in ("a", "b", "c"):
        buffer.set_transform("map", child, SECOND, *POSE)
    assert buffer.remove_frame("a")
    assert buffer.frames() == ["map", "b", "c"]
    buffer.set_transform("map", "new", SECOND, *POSE)
    buffer.set_transform("map", "a", SECOND, *POSE)
    assert buffer.frames() == ["map", "b", "c", "new", "a"]
    assert [line.split()[1] for line in buffer._frames_as_string().splitlines()] == [
        "b",
        "c",
        "new",
        "a",
    ]
    assert buffer.lookup_transform("map", "new").target_frame == "map"
    assert "nobody" not in buffer.frames()
    assert buffer._fault() == ""


def test_all_parents_of_a_removed_frame_go(core: Any) -> None:
    buffer = core.Buffer()
    for stamp, parent in enumerate(("p", "q", "p", "r"), 1):
        buffer.set_transform(parent, "child", stamp * SECOND, *POSE)
    buffer.set_transform("q", "other", SECOND, *POSE)
    assert buffer.remove_frame("child")
    assert buffer.frames() == ["q", "other"]
    assert buffer._fault() == ""


def test_a_sender_keeps_the_name_of_its_former_parent(core: Any) -> None:
    buffer = core.Buffer(SECOND)
    buffer.set_transform("old", "cup", SECOND, *POSE)
    buffer.set_transform("table", "cup", 5 * SECOND, *POSE)
    buffer.set_transform("table", "cup", 9 * SECOND, *POSE)
    buffer.set_transform("map", "old", SECOND, *POSE)
    assert buffer.remove_frame("old")
    buffer.set_transform("map", "new", SECOND, *POSE)
    ((*_, senders),) = [row for row in buffer._describe_links(9) if row[0] == "cup"]
    assert [row[1] for row in senders] == ["old", "table"]
    assert buffer._fault() == ""


def test_a_path_that_is_known_does_not_lead_to_a_frame_of_the_same_number(core: Any) -> None:
    buffer = core.Buffer()
    buffer.set_transform("map", "a", SECOND, (1.0, 0.0, 0.0), POSE[1])
    buffer.set_transform("map", "b", SECOND, (2.0, 0.0, 0.0), POSE[1])
    map_, a = "map", "a"
    assert buffer.lookup_transform(map_, a).x == 1.0
    buffer.remove_frame("a")
    buffer.set_transform("map", "c", SECOND, (3.0, 0.0, 0.0), POSE[1])
    assert not buffer.can_transform(map_, a)
    assert buffer.lookup_transform(map_, "c").x == 3.0


def test_removing_many_frames_takes_linear_time(core: Any) -> None:
    """Ten times the frames take ten times as long, not a hundred times."""

    def seconds(count: int) -> float:
        buffer = core.Buffer()
        for i in range(count):
            buffer.set_transform("map", f"f{i}", SECOND, *POSE)
        started = time.thread_time()
        assert len(buffer.remove_stale(2 * SECOND)) == count
        return time.thread_time() - started

    few, many = (min(seconds(count) for _ in range(3)) for count in (1500, 15_000))
    assert many < 40 * max(few, 1e-4)


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="reads /proc")
def test_memory_stays_flat(core: Any) -> None:
    """50 rounds of 3,000 new names grow by less than a tenth of what the names take."""
    program = f"""
from {core.__name__} import Buffer
from pathlib import Path
buffer, sizes = Buffer(), []
for round in range(50):
    for i in range(3000):
        name = f"frame {{i}} of round {{round}}, with a name of some length"
        buffer.set_transform("map", name, (round + 1) * 10**9, (0, 0, 0), (0, 0, 0, 1))
    assert len(buffer.remove_stale((round + 2) * 10**9)) == 3000
    sizes.append(int(Path("/proc/self/statm").read_text().split()[1]) * 4)
print(sizes[-1] - sizes[4])
"""
    run = run_python(program)
    # 45 rounds of links and names are 60,000 kB. The kernel may add a huge page of 2,048 kB.
    assert int(run.stdout) < 6000
