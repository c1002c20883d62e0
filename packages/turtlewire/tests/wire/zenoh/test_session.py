"""A session that ends while something is declared in it."""

from __future__ import annotations

import contextlib

import pytest

from turtlewire.errors import WireError
from turtlewire.wire import open_context
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.qos import QoS

KIND = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
TYPES = ServiceTypes("std_srvs/srv/SetBool", KIND, KIND, lambda _: "RIHS01_" + "1" * 64)


@pytest.mark.parametrize("what", ["publisher", "subscription", "client", "service"])
def test_declaration_rejected_by_zenoh_is_named(what: str):
    with contextlib.closing(open_context(middleware="rmw_zenoh_cpp")) as context:
        node = context.create_node("node")
        context._core.session.close()
        kind = KIND if what in ("publisher", "subscription") else TYPES
        with pytest.raises(WireError, match=f"create {what} /name: session closed"):
            getattr(node, f"create_{what}")("/name", kind, QoS())
