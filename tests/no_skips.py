"""Makes tests fail that miss something which can be installed, with ``TURTLEWIRE_NO_SKIPS=1``.

On a user's machine, such tests are skipped. `.ci/run` installs all that they need: there, a skipped
test is a package that has disappeared or a download that has failed.
"""

import os
import re

import pytest

#: Reasons that say what to install. Others are of the system, for example "only Linux has /proc".
_INSTALLABLE = re.compile(r"\binstall|scripts/|Skipped: needs |could not import")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport():
    """Fail instead of a skip."""
    return _without_skip((yield))


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report():
    """Fail instead of a skip of a whole module."""
    return _without_skip((yield))


def _without_skip(report):
    is_strict = os.environ.get("TURTLEWIRE_NO_SKIPS") == "1"
    # An expected failure counts as skipped, too, and has no reason.
    if is_strict and report.skipped and isinstance(report.longrepr, tuple):
        reason = report.longrepr[2]
        if _INSTALLABLE.search(reason):
            report.outcome = "failed"
            report.longrepr = f"TURTLEWIRE_NO_SKIPS=1 forbids this skip. {reason}"
    return report
