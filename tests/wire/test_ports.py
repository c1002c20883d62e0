"""Participants of this host are counted by their ports."""

from __future__ import annotations

import sys

import pytest
from turtlewire.wire import environment, open_context
from turtlewire.wire.cyclone.ports import participants_on_host

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="only Linux lists the bound ports")


def test_participants_are_counted_while_they_are_there():
    domain = environment.domain_id()
    before = participants_on_host(domain)
    first, second = open_context(), open_context()
    assert participants_on_host(domain) == before + 2
    first.close()
    second.close()
    assert participants_on_host(domain) == before


def test_a_graph_is_incomplete_until_it_knows_the_others():
    one = open_context()
    node = one.create_node("early")
    other = open_context()
    assert other.graph.wait_for(other.graph.is_complete, timeout_ns=20_000_000_000)
    node_names = [info.name for info in other.graph.nodes()]
    other.close()
    node.close()
    one.close()
    assert "early" in node_names


def test_where_the_system_does_not_tell_nothing_is_counted(monkeypatch):
    def refuse(*_args, **_kwargs):
        raise FileNotFoundError

    monkeypatch.setattr("builtins.open", refuse)
    assert participants_on_host(7) is None
