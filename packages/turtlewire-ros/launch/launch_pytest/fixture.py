"""The decorator of fixtures that return a launch description."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import pytest

from launch import LaunchContext, LaunchService

_SCOPES = ("function", "class", "module", "package", "session")


@dataclass(frozen=True)
class FixtureOptions:
    """The options of a fixture, as its decorator sets them."""

    #: The name by which pytest knows it.
    name: str
    #: pytest's scope.
    scope: str
    #: Whether the launch ends when all its processes have ended.
    shutdown_when_idle: bool
    #: Whether the end of the tests ends the launch.
    auto_shutdown: bool


def finalize_launch_service(
    launch_service: LaunchService,
    eprefix: str = "",
    auto_shutdown: bool = True,
    task: asyncio.Task[int] | None = None,
) -> None:
    """End a launch, and wait for its end.

    Args:
        launch_service: The launch.
        eprefix: Begins the text of the error.
        auto_shutdown: Whether to end it; otherwise it must end by itself.
        task: The task that runs it, by default the one that the launch knows.

    Raises:
        AssertionError: The launch itself has failed.
    """
    if auto_shutdown:
        launch_service.shutdown()
    task = launch_service.task if task is None else task
    if task is None or task.get_loop().is_closed():
        return
    status = task.get_loop().run_until_complete(task)
    assert status == 0, f"{eprefix}launch service failed when finishing, return code '{status}'"


def get_event_loop_fixture(*, scope: str = "function", overridable: bool = True) -> Any:
    """Make the fixture ``event_loop``: the loop that launch and tests share.

    Args:
        scope: pytest's scope.
        overridable: Whether a launch fixture of a wider scope may put another in its place.
    """

    def event_loop() -> Iterator[asyncio.AbstractEventLoop]:
        """Yield the event loop of launch and tests."""
        loop = asyncio.new_event_loop()
        yield loop
        loop.run_until_complete(loop.shutdown_asyncgens())
        loop.run_until_complete(loop.shutdown_default_executor())
        loop.close()

    return _made(event_loop, scope, overridable)


def get_launch_service_fixture(*, scope: str = "function", overridable: bool = True) -> Any:
    """Make the fixture ``launch_service``; arguments as for the event loop."""

    def launch_service(event_loop: asyncio.AbstractEventLoop) -> LaunchService:
        """Return the launch."""
        del event_loop  # it must outlive the launch
        return LaunchService()

    return _made(launch_service, scope, overridable)


def get_launch_context_fixture(*, scope: str = "function", overridable: bool = True) -> Any:
    """Make the fixture ``launch_context``; arguments as for the event loop."""

    def launch_context(launch_service: LaunchService) -> LaunchContext:
        """Return the context of the launch."""
        return launch_service.context

    return _made(launch_context, scope, overridable)


def scope_gt(scope1: str, scope2: str) -> bool:
    """Return True if the first of two scopes of pytest is the wider one."""
    return _SCOPES.index(scope1) > _SCOPES.index(scope2)


def fixture(
    decorated: Callable[..., Any] | None = None,
    *args: Any,
    shutdown_when_idle: bool = True,
    auto_shutdown: bool = True,
    **kwargs: Any,
) -> Any:
    """Decorate a function that returns a launch description with a ``ReadyToTest``.

    It becomes a fixture that runs the launch; tests name it in ``@pytest.mark.launch(fixture=…)``.
    With a scope wider than ``function``, the module gets fixtures ``event_loop``,
    ``launch_service`` and ``launch_context`` of that scope unless it has its own.

    Args:
        decorated: The function.
        *args: For :func:`pytest.fixture`.
        shutdown_when_idle: Whether the launch ends when all its processes have ended.
        auto_shutdown: Whether the end of the tests ends the launch.
        **kwargs: For :func:`pytest.fixture`.
    """
    scope = kwargs.get("scope", "function")
    if scope != "function":
        # pytest looks for them in the module of the decorated function.
        _widen(sys._getframe(1).f_globals, scope)

    def decorate(function: Callable[..., Any]) -> Any:
        function._launch_pytest = FixtureOptions(  # type: ignore[attr-defined]
            name=kwargs.get("name") or function.__name__,
            scope=scope,
            shutdown_when_idle=shutdown_when_idle,
            auto_shutdown=auto_shutdown,
        )
        return pytest.fixture(function, *args, **kwargs)

    return decorate if decorated is None else decorate(decorated)


def _made(function: Callable[..., Any], scope: str, overridable: bool) -> Any:
    function._launch_pytest_scope = scope if overridable else None  # type: ignore[attr-defined]
    return pytest.fixture(function, scope=scope)  # type: ignore[call-overload]


def _widen(namespace: dict[str, Any], scope: str) -> None:
    """Give a module the fixtures of a scope, in the place of narrower ones of this package."""
    for name, make in (
        ("event_loop", get_event_loop_fixture),
        ("launch_service", get_launch_service_fixture),
        ("launch_context", get_launch_context_fixture),
    ):
        existing = namespace.get(name)
        known = getattr(existing, "_launch_pytest_scope", None)
        if existing is None or (known is not None and scope_gt(scope, known)):
            namespace[name] = make(scope=scope)
