"""The tutorial's listings, unchanged, in a package of that name.

Four processes over Cyclone DDS behave as they did on a real ROS 2.
"""

import hashlib
import re
from itertools import pairwise
from pathlib import Path

from tests.places import ROS2

HERE = Path(__file__).parent
VERBATIM = HERE / "verbatim" / "learning_tf2_py"
GOLDEN = HERE.parent / "golden" / "tutorial" / "main"
LISTINGS = {
    "learning_tf2_py/turtle_tf2_broadcaster.py": (
        "c3f2063ce831a95193191752eba4c8d7227d6ce85de754019467be162ae0f8ab"
    ),
    "learning_tf2_py/turtle_tf2_listener.py": (
        "092ec3f9d2a181b4bccb2c851a05054db6fbc6e86449b9ecee8acefc55117892"
    ),
    "launch/turtle_tf2_demo.launch.py": (
        "6b4c39bd73a786080deff6e04930817069a525fa61bf7d0b57344021e7bb8017"
    ),
}
COULD_NOT = (
    r"^\[turtle_tf2_listener-4\] \[INFO\] \[(\d+\.\d+)\] \[listener\]: (Could not retrieve "
    r"transform: .*)$"
)
#: What a lookup of the latest time says between the first and the second pose of turtle2. Whether
#: the listener's timer fires in these 16 ms is chance: the captured run has no such line.
ONE_POSE_YET = re.compile(
    r"\[turtle_tf2_listener-4\] \[INFO\] \[TIME\] \[listener\]: Could not retrieve transform: "
    r"Lookup would require extrapolation .* frame \[turtle1\] to frame \[turtle2\]"
)
SPAWN = "{x: 4.0, y: 2.0, theta: 0.0, name: 'turtle2'}"


def additions(text, golden):
    """Normalised lines that the captured run has not.

    `ONE_POSE_YET` and the order of ends aside.
    """
    return {
        line
        for line in normalised(text) - normalised(golden)
        if "has finished cleanly" not in line and not ONE_POSE_YET.fullmatch(line)
    }


def normalised(text):
    """Lines without times, process ids and paths."""
    text = re.sub(r"\[\d{10}\.\d{9}\]", "[TIME]", text)
    text = re.sub(r"\[pid \d+\]|pid \[\d+\]", "PID", text)
    text = re.sub(r"below \S+", "below LOGS", text)
    return set(text.splitlines())


def test_the_listings_are_the_tutorial_s_to_the_byte():
    for name, digest in LISTINGS.items():
        assert hashlib.sha256((VERBATIM / name).read_bytes()).hexdigest() == digest, name


def test_a_lookup_between_the_first_two_poses_is_no_difference():
    head = "[turtle_tf2_listener-4] [INFO] [1795218216.688223279] [listener]: Could not retrieve"
    early = (
        f"{head} transform: Lookup would require extrapolation at time 1795218216.688000, but only "
        "time 1795218216.690000 is in the buffer, when looking up transform from frame [turtle1] "
        "to frame [turtle2]"
    )
    other = f"{head} transform: Could not find a connection"
    assert additions(f"{early}\n{other}", "") == normalised(other)


def test_it_reports_the_missing_turtle_then_follows_it_and_stops_at_ctrl_c(run, workspace, turtles):
    launch = run(
        ROS2,
        "launch",
        "learning_tf2_py",
        "turtle_tf2_demo.launch.py",
        environment=workspace(VERBATIM),
    )

    reports = launch.wait_for(COULD_NOT, count=3)
    golden = (GOLDEN / "launch.stdout.txt").read_text()
    assert {report[2] for report in reports} == {
        line[2] for line in re.finditer(COULD_NOT, golden, re.MULTILINE)
    }
    stamps = [float(report[1]) for report in reports]
    # The listener asks ten times a second; a failed lookup is shown once a second.
    assert min(later - earlier for earlier, later in pairwise(stamps)) > 0.9
    launch.wait_for(re.escape(f'ros2 service call /spawn turtlesim/srv/Spawn "{SPAWN}"'))

    spawn = run(ROS2, "service", "call", "/spawn", "turtlesim/srv/Spawn", SPAWN)
    assert spawn.wait() == 0, spawn.text
    # ROS 2 prints it, too, while it has not found the service.
    answer = spawn.text.replace("waiting for service to become available...", "")
    assert answer.split() == (GOLDEN / "spawn.stdout.txt").read_text().split()
    turtles.wait_for(lambda: len(turtles.poses) == 2 and turtles.distance() < 2.0)

    launch.end(4)
    hints = "[turtle_tf2_listener-4]     "  # below a failed lookup
    ours = [line for line in additions(launch.text, golden) if not line.startswith(hints)]
    assert all(line.startswith("[turtlesim_node-1] [INFO] [TIME] [sim]: ") for line in ours), ours
    assert len(ours) <= 2, ours  # the page's address, and the command to type
