"""Examines the setup, the graph and the transforms, and reports problems with advice."""

from __future__ import annotations

import json
import os
import sys
import time
from contextlib import nullcontext
from typing import TYPE_CHECKING

from turtlewire.doctor.fast_dds_findings import (
    fast_dds_environment,
    out_of_reach,
    sharing_processes,
)
from turtlewire.doctor.fast_dds_search import FastDdsSearch
from turtlewire.doctor.finding import Finding, problem
from turtlewire.doctor.graph_findings import graph_findings
from turtlewire.doctor.setup_findings import network_findings, setup_findings, wait_for_graph
from turtlewire.doctor.tf_findings import tf_findings
from turtlewire.doctor.tf_traffic import TfListener, tf_publishers
from turtlewire.errors import WireError
from turtlewire.terminal.printable import printable
from turtlewire.tf.tf_topics import TfTopics
from turtlewire.wire.environment import Range, discovery, is_installed, middleware_name
from turtlewire.wording import counted

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from turtlewire.wire.base import Graph

_LISTEN_S = 2.0


def examine(listen_s: float | None = None, topics: TfTopics | None = None) -> list[Finding]:
    """Examine the setup, the graph and the transforms.

    Args:
        listen_s: How long to listen to the transforms [s]. None listens until there is enough of
            each publisher, at most for two seconds, and for the full time if something looks wrong.
        topics: Where the transforms are published; None: ``/tf`` and ``/tf_static``.
    """
    from turtlewire.wire import open_context

    found = setup_findings(os.environ, sys.path) + network_findings()
    found += fast_dds_environment(os.environ, middleware_name())
    try:
        context = open_context()
    except WireError as error:
        return [*found, problem(str(error), error.hint)]
    try:
        graph = context.graph
        context.create_node("_turtlewire_doctor")
        topics = topics or TfTopics()
        listener = TfListener(context, topics)
        with _fast_dds_search(context.domain_id) as search:
            wait_for_graph(graph)
            if listen_s is None:
                _listen(listener, graph)
            elif tf_publishers(graph, topics):
                listener.wait(listen_s)
            silent = _silent_findings(graph, search, context.domain_id)
        traffic = listener.close()
        seen = graph_findings(graph, explained=bool(silent))
        return [*found, *silent, *seen, *tf_findings(graph, traffic)]
    finally:
        context.close()


def _fast_dds_search(domain_id: int) -> AbstractContextManager[FastDdsSearch | None]:
    """Ask the participants on Fast DDS, if Cyclone DDS is to reach them."""
    range_ = discovery().range
    if middleware_name() != "rmw_cyclonedds_cpp" or range_ == Range.OFF:
        return nullcontext()
    return FastDdsSearch(domain_id, wide=range_ != Range.LOCALHOST)


def _silent_findings(graph: Graph, search: FastDdsSearch | None, domain_id: int) -> list[Finding]:
    if search is None:
        return []
    return out_of_reach(graph, search.answers(), sharing_processes(domain_id))


def _listen(listener: TfListener, graph: Graph) -> None:
    end = time.monotonic() + _LISTEN_S
    heard_all = listener.gather(graph, _LISTEN_S)
    # Messages that seem to be missing may still arrive.
    if not heard_all and tf_findings(graph, listener.traffic()):
        listener.wait(max(0.0, end - time.monotonic()))


def full_report(findings: list[Finding]) -> str:
    """Return the findings of `examine` as text, below a line with the verdict and the network."""
    verdict = _verdict(findings)
    return f"{verdict}\n{report(findings)}" if findings else verdict


def _verdict(findings: list[Finding]) -> str:
    count = sum(finding.is_problem for finding in findings)
    found = f"{counted(count, 'problem')} found" if count else "All is well"
    middleware = middleware_name()
    if not is_installed(middleware):
        middleware = "none"
    # As it is set: an invalid value is among the findings.
    domain = os.environ.get("ROS_DOMAIN_ID", "").strip() or "0"
    network = f"middleware {middleware}, discovery range {discovery().range.value}"
    return f"{found}: {network}, domain {printable(domain)}."


def report(findings: list[Finding]) -> str:
    """Return the findings as text, problems first."""
    if not findings:
        return "No problems found."
    lines = []
    for finding in _by_weight(findings):
        kind = "PROBLEM" if finding.is_problem else "note"
        lines += [f"{kind}: {printable(finding.text)}", f"    {printable(finding.remedy)}"]
    return "\n".join(lines)


def as_json(findings: list[Finding]) -> str:
    """Return the findings as a JSON object in one line, problems first."""
    return json.dumps({"findings": [finding._asdict() for finding in _by_weight(findings)]})


def _by_weight(findings: list[Finding]) -> list[Finding]:
    return sorted(findings, key=lambda finding: not finding.is_problem)
