"""The captured command lines of a real ROS 2, replayed.

What deviates is listed here with its reason.
"""

import sys
from concurrent.futures import ThreadPoolExecutor

import pytest
from tests.golden.cli import replay
from tests.golden.cli.captures import captures
from tests.needs import needs_cyclone_dds

from ros2cli.node.daemon import shutdown_daemon, spawn_daemon
from turtlewire.testing import reserved_domain

CPP = (
    "turtlesim is a Python node here: it ends with an exception and status 1, where the C++ one "
    "aborts (250)"
)
CLEAN_END = "Ctrl-C ends without an error line"

VERB_USAGE = "an unknown option shows the usage of the verb, not of ros2"
OWN_HELP = "the descriptions of the verbs are ours, and so are the commands"
OWN_PACKAGES = "it shows what is installed: no components of C++, another licence"
INTERPRETER = "scripts run on our interpreter, whatever their first line says"
DOCTOR = "it prints findings with remedies"
LATER_OPTION = "the usage names options of Kilted or Lyrical"
NEW_ARGPARSE = "Python 3.14 writes `[--stdin | values]`"

#: Captured while the daemon ran, which ROS 2 had started by itself.
BESIDE_THE_DAEMON = (175, 176, 719, 722)

#: Cases that deviate on purpose. All others have to agree.
DEVIATIONS = {
    **dict.fromkeys((161, 163, 164, 166, 167, 169, 170, 172), CPP),
    **dict.fromkeys((68, 331), VERB_USAGE),
    **dict.fromkeys((71, 73, 74), LATER_OPTION),
    **({74: NEW_ARGPARSE} if sys.version_info >= (3, 14) else {}),
    503: OWN_HELP,
    **dict.fromkeys((587, 737), OWN_PACKAGES),
    731: INTERPRETER,
    **dict.fromkeys((710, 713), DOCTOR),
    **dict.fromkeys((160, 223, 269, 316, 317, 322), CLEAN_END),
}


BLOCKS = replay.blocks(captures())


def differences(case, environment=None):
    if case.number in BESIDE_THE_DAEMON:
        return differences_beside_the_daemon(case)
    return replay.differences(case, replay.replay(case, environment))


def differences_beside_the_daemon(case):
    """In a domain of its own: elsewhere, the other commands would see the daemon's node."""
    with reserved_domain() as domain, pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_DOMAIN_ID", str(domain))
        assert spawn_daemon(None)
        try:
            return replay.differences(case, replay.replay(case))
        finally:
            shutdown_daemon(None, timeout=60)


def differences_alone(case):
    """In its own domain: the nodes of several cases have the same names."""
    with reserved_domain() as domain:
        return differences(case, {"ROS_DOMAIN_ID": str(domain)})


def disagreeing(block, differences=differences, at_once=1):
    """Number and differences of the cases that do not agree.

    Those that do not change what the others see may run at the same time.
    """
    with replay.surroundings(block[0].number), ThreadPoolExecutor(at_once) as pool:
        results = pool.map(differences, block)
        found = dict(zip(block, results, strict=True))
    return {case.number: [case.command, *lines] for case, lines in found.items() if lines}


def unexpected(found):
    return {number: lines for number, lines in found.items() if number not in DEVIATIONS}


def test_all_captures_are_read():
    assert sum(len(block) for block in BLOCKS) == 210 + 54
    assert sum(len(case.stdout) + len(case.stderr) > 0 for block in BLOCKS for case in block) > 190


@pytest.mark.parametrize(
    "first", [65, 91, 122, 146], ids=["usage", "packages", "errors", "ros_args"]
)
def test_commands_without_nodes(first):
    last = {65: 90, 91: 121, 122: 145, 146: 173}[first]
    block = [case for case in BLOCKS[0] if first <= case.number <= last]
    assert block
    assert unexpected(disagreeing(block, differences_alone, at_once=4)) == {}


@pytest.mark.slow
@needs_cyclone_dds  # of which the padding of raw bytes is captured
def test_messages_of_all_kinds_are_shown():
    block = BLOCKS[-2]
    assert len(block) == 38
    assert unexpected(disagreeing(block, at_once=4)) == {}


@pytest.mark.slow
@pytest.mark.timeout(900)
def test_commands_beside_servers():
    assert unexpected(disagreeing(BLOCKS[-1])) == {}


@pytest.mark.slow
@pytest.mark.timeout(900)
def test_commands_beside_the_demo():
    found = {}
    for block in BLOCKS[1:-2]:
        found |= disagreeing(block)
    assert unexpected(found) == {}


def test_deviations_are_few():
    # Those of other versions, of Python or of ROS 2, are not ours.
    ours = [why for why in DEVIATIONS.values() if why not in (NEW_ARGPARSE, LATER_OPTION)]
    assert len(set(ours)) <= 8
    assert len(ours) <= 0.1 * sum(len(block) for block in BLOCKS)


def test_deviations_are_among_the_captures():
    assert DEVIATIONS.keys() <= {case.number for block in BLOCKS for case in block}
