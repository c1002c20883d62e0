"""The wait for a router that ZENOH_ROUTER_CHECK_ATTEMPTS asks for."""

from __future__ import annotations

import contextlib
import socket
import threading

import pytest
import zenoh

from turtlewire.wire import open_context, report
from turtlewire.wire.zenoh.configuration import router_configuration

NO_ROUTER = "Unable to connect to a Zenoh router. Have you started a router with"


@pytest.fixture
def port(monkeypatch: pytest.MonkeyPatch) -> int:
    """A free port, where sessions look for a router."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        free = int(probe.getsockname()[1])
    monkeypatch.setenv("ZENOH_CONFIG_OVERRIDE", f'connect/endpoints=["tcp/127.0.0.1:{free}"]')
    monkeypatch.setattr(report, "_said", set())
    return free


def open_and_close() -> None:
    with contextlib.closing(open_context(middleware="rmw_zenoh_cpp")):
        pass


@contextlib.contextmanager
def router(port: int):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ZENOH_CONFIG_OVERRIDE", f'listen/endpoints=["tcp/127.0.0.1:{port}"]')
        configuration = router_configuration()
    with zenoh.open(configuration):
        yield


@pytest.mark.parametrize("attempts", [None, "", "-1"])
def test_nothing_is_waited_for(attempts, port, monkeypatch, capfd):
    if attempts is not None:
        monkeypatch.setenv("ZENOH_ROUTER_CHECK_ATTEMPTS", attempts)
    open_and_close()
    assert capfd.readouterr().err == ""


def test_a_session_goes_on_without_a_router(port, monkeypatch, capfd):
    monkeypatch.setenv("ZENOH_ROUTER_CHECK_ATTEMPTS", "1")
    open_and_close()
    first, second = capfd.readouterr().err.splitlines()
    assert NO_ROUTER in first
    assert "Unable to connect to a Zenoh router after 1 attempt(s)" in second


@pytest.mark.parametrize("attempts", ["0", "600"])
def test_a_router_that_is_there(attempts, port, monkeypatch, capfd):
    monkeypatch.setenv("ZENOH_ROUTER_CHECK_ATTEMPTS", attempts)
    with router(port):
        open_and_close()
    assert capfd.readouterr().err.count("Unable") <= 1  # its link may come a moment later


def test_a_router_that_starts_during_the_wait(port, monkeypatch, capfd):
    monkeypatch.setenv("ZENOH_ROUTER_CHECK_ATTEMPTS", "0")
    warned = threading.Event()
    monkeypatch.setattr(
        "turtlewire.wire.zenoh.router.warn", lambda text: warned.set() or report.warn(text)
    )
    opening = threading.Thread(target=open_and_close)
    opening.start()
    assert warned.wait(60)
    with router(port):
        opening.join(60)
        assert not opening.is_alive()
    [line] = capfd.readouterr().err.splitlines()
    assert NO_ROUTER in line


def test_a_number_that_is_none(port, monkeypatch, capfd):
    monkeypatch.setenv("ZENOH_ROUTER_CHECK_ATTEMPTS", "often")
    open_and_close()
    [line] = capfd.readouterr().err.splitlines()
    assert "ZENOH_ROUTER_CHECK_ATTEMPTS is not an integer" in line
