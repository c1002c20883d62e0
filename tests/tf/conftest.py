"""Tests that take `Buffer` run on both cores."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    import turtlewire


def cores() -> list[Any]:
    from turtlewire.tf import plain

    found: list[Any] = [pytest.param(plain, id="python")]
    try:
        from turtlewire import _native
    except ModuleNotFoundError:
        found.append(pytest.param(None, id="native", marks=pytest.mark.skip(reason="the compiled core is not built here")))
    else:
        found.append(pytest.param(_native, id="native"))
    return found


@pytest.fixture(params=cores())
def core(request: pytest.FixtureRequest) -> Any:
    """A module with `Buffer` and `Transform`."""
    return request.param


@pytest.fixture
def buffer(core: Any) -> turtlewire.Buffer:
    made: turtlewire.Buffer = core.Buffer()
    return made
