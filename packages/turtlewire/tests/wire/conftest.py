"""Contexts on Cyclone DDS; some modules have a `context` of their own."""

import pytest

from turtlewire import msg
from turtlewire.wire import open_context
from turtlewire.wire.base import ServiceTypes, TypeId


@pytest.fixture
def context():
    opened = open_context(middleware="rmw_cyclonedds_cpp")
    yield opened
    opened.close()


@pytest.fixture
def contexts():
    opened = [open_context(middleware="rmw_cyclonedds_cpp") for _ in range(2)]
    yield opened
    for context in opened:
        context.close()


@pytest.fixture
def types():
    """The types of a service without fields."""
    name = "std_srvs/srv/Empty"
    request, response = (
        TypeId(f"{name}_{part}", msg.type_hash(f"{name}_{part}"))
        for part in ("Request", "Response")
    )
    return ServiceTypes(name, request, response, msg.type_hash)
