"""The names, parameters, defaults and members of a real ROS 2 Jazzy's packages are here, too.

`tests/golden/surface.json` holds them, 4301 in 509 modules. What differs on purpose stands in
`differences.txt`, below the reason in brackets; `*` stands for any text. The lines above the
reasons are a ratchet: how many are equal at least, and how many differences at most have no reason
yet. `compare.py` prints the differences:

    python tests/surface/compare.py rclpy
"""

import json
import subprocess
import sys
from fnmatch import fnmatchcase
from pathlib import Path

import pytest

from tests import archive

HERE = Path(__file__).parent
GOLDEN = json.loads((HERE.parent / "golden" / "surface.json").read_text(encoding="utf-8"))
DIFFERENCES = archive.read(HERE / "differences.txt")

#: What issue 12 asks for, in percent.
ASKED = {
    "launch": 95,
    "launch_ros": 95,
    "launch_testing": 90,
    "rclpy": 95,
    "ros2cli": 80,
    "rosidl": 85,
    "tf2": 92,
}

#: What a class inherits from the standard library of newer Pythons.
ADDED_IN_3_11 = ["ros2cli.xmlrpc.local_server.LocalXMLRPCServer.allow_reuse_port"]

#: What a class inherits from the standard library, and what other Pythons have otherwise.
OF_PYTHON = "ros2cli.daemon.RequestHandler.*"


class Differences:
    """One file of differences: the ratchet, and the reason of each pattern."""

    def __init__(self, text):
        self.reasons = {}
        self.ratchet = {}
        reason = None
        for line in map(str.strip, text.splitlines()):
            if line.startswith("[") and line.endswith("]"):
                reason = line[1:-1]
            elif line and reason is None:
                word, number = line.split()
                self.ratchet[word] = int(number)
            elif line:
                self.reasons[line] = reason

    def reason(self, name):
        return next((why for what, why in self.reasons.items() if fnmatchcase(name, what)), None)


@pytest.mark.parametrize("golden", ASKED)
def test_share(golden):
    run = subprocess.run(
        [sys.executable, str(HERE / "compare.py"), "--json", golden],
        stdout=subprocess.PIPE,
        check=True,
        timeout=840,
    )
    found = json.loads(run.stdout)
    if sys.version_info < (3, 11):
        for name in ADDED_IN_3_11:
            found["differences"].pop(name, None)
    for name in [each for each in found["differences"] if fnmatchcase(each, OF_PYTHON)]:
        found["differences"].pop(name)
    listed = Differences(DIFFERENCES[golden].content.decode())
    open_ends = {
        name: weight
        for name, (_, weight) in found["differences"].items()
        if not listed.reason(name)
    }
    equal = found["total"] - sum(weight for _, weight in found["differences"].values())
    unexplained = sum(open_ends.values())
    shown = f"{golden}: {equal} of {found['total']} equal ({equal / found['total']:.1%}, "
    shown += f"asked {ASKED[golden]} %), {unexplained} without a reason"
    assert equal >= listed.ratchet["equal"], shown
    assert unexplained <= listed.ratchet["unexplained"], (shown, sorted(open_ends))
    stale = [
        what
        for what in listed.reasons
        if not any(fnmatchcase(name, what) for name in found["differences"])
    ]
    assert stale == [], "listed as different, but they are equal"


def test_every_package_is_compared():
    assert GOLDEN.keys() == DIFFERENCES.keys() == ASKED.keys()
    assert sum(map(len, GOLDEN.values())) == 509


def test_a_difference_is_seen():
    """The comparison itself: what fits a call that is written for ROS 2, and what does not."""
    calls = """
from compare import fits, same_member
assert fits("(a, b=1)", "(a, b=1, c=2)")
assert fits("(self, *, depth=<X: 1>)", "(self, *, depth=<Y.X: 1>)")
assert not fits("(a, b=1)", "(a, b=2)")
assert not fits("(a, b=1)", "(b, a)")
assert not fits("(a)", "(a, b)")
assert not fits("async (a)", "(a)")
assert same_member("property", "property set")
assert not same_member("value 1", "value 2")
"""
    subprocess.run([sys.executable, "-c", calls], cwd=HERE, check=True, timeout=840)
