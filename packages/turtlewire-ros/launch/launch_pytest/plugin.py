"""Runs launch fixtures, and the tests that are marked ``launch``."""

from __future__ import annotations

import asyncio
import functools
import inspect
from collections.abc import Callable, Generator, Iterable, Iterator
from typing import TYPE_CHECKING, Any

import pytest

from launch import LaunchDescription
from launch_pytest.fixture import (
    finalize_launch_service,
    get_event_loop_fixture,
    get_launch_context_fixture,
    get_launch_service_fixture,
)
from launch_pytest.wrapped_tests import (
    run_until_complete,
    wrap_asyncgen,
    wrap_asyncgen_fscope,
    wrap_coroutine,
    wrap_func,
    wrap_generator,
    wrap_generator_fscope,
)
from launch_testing.actions.ready import ReadyToTest

if TYPE_CHECKING:
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch_pytest.fixture import FixtureOptions

__all__ = [
    "event_loop",
    "from_parent",
    "generate_test_items",
    "get_launch_test_fixture",
    "get_launch_test_fixture_scope",
    "get_launch_test_fixturename",
    "get_ready_to_test_action",
    "has_shutdown_kwarg",
    "is_launch_test",
    "is_launch_test_mark_valid",
    "is_same_launch_test_fixture",
    "is_shutdown_test",
    "is_valid_test_item",
    "iterate_ready_to_test_actions",
    "launch_context",
    "launch_service",
    "need_shutdown_test_item",
    "pytest_collection_modifyitems",
    "pytest_configure",
    "pytest_fixture_setup",
    "pytest_pycollect_makeitem",
    "pytest_pyfunc_call",
    "run_until_complete",
    "wrap_asyncgen",
    "wrap_asyncgen_fscope",
    "wrap_coroutine",
    "wrap_func",
    "wrap_generator",
    "wrap_generator_fscope",
]

event_loop = get_event_loop_fixture()
launch_service = get_launch_service_fixture()
launch_context = get_launch_context_fixture()

_SUFFIX = "[shutdown_test]"


def pytest_configure(config: pytest.Config) -> None:
    """Make the marker known."""
    config.addinivalue_line(
        "markers", "launch(fixture, shutdown=False): marks a test of what a launch fixture starts"
    )


# the launch


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_fixture_setup(
    fixturedef: pytest.FixtureDef[Any], request: pytest.FixtureRequest
) -> Generator[None, Any, Any]:
    """Run what a launch fixture describes, up to its ``ReadyToTest``."""
    options: FixtureOptions | None = getattr(fixturedef.func, "_launch_pytest", None)
    if options is None:
        return (yield)
    # Requested before the launch, so that they outlive it.
    loop = request.getfixturevalue("event_loop")
    service = request.getfixturevalue("launch_service")
    result = yield
    description = result[0] if isinstance(result, (tuple, list)) else result
    ready = asyncio.Event()
    _ready_to_test(description).add_callback(ready.set)
    service.include_launch_description(description)
    task = loop.create_task(service.run_async(shutdown_when_idle=options.shutdown_when_idle))
    # Before the launch runs: it must also end if it never becomes ready.
    fixturedef.addfinalizer(
        functools.partial(
            finalize_launch_service,
            service,
            eprefix=f"When tearing down {options.name}: ",
            auto_shutdown=options.auto_shutdown,
        )
    )
    run_until_complete(loop, _first(task, ready))
    if not ready.is_set():
        pytest.fail(f"The launch of {options.name} ended before its ReadyToTest", pytrace=False)
    return result


async def _first(task: asyncio.Task[int], ready: asyncio.Event) -> None:
    """Wait until the launch is ready or has ended."""
    waiting = asyncio.ensure_future(ready.wait())
    await asyncio.wait({task, waiting}, return_when=asyncio.FIRST_COMPLETED)
    waiting.cancel()


def _ready_to_test(launch_description: LaunchDescription) -> ReadyToTest:
    """Return the one ``ReadyToTest`` of a description; without one, it is added at the end.

    Raises:
        RuntimeError: The fixture is ambiguous.
        TypeError: The fixture returns no launch description.
    """
    if isinstance(launch_description, LaunchDescription) and not any(
        iterate_ready_to_test_actions(launch_description.entities)
    ):
        launch_description.add_action(ReadyToTest())
    return get_ready_to_test_action(launch_description)


def get_ready_to_test_action(launch_description: LaunchDescription) -> ReadyToTest:
    """Return the one ``ReadyToTest`` of a description.

    Raises:
        RuntimeError: The fixture is missing, ambiguous, or not a launch description.
    """
    if not isinstance(launch_description, LaunchDescription):
        raise TypeError(
            "a launch fixture must return a LaunchDescription, or a list that begins with one, "
            f"not {type(launch_description).__name__}"
        )
    actions = list(iterate_ready_to_test_actions(launch_description.entities))
    if len(actions) != 1:
        raise RuntimeError(
            "launch_pytest fixtures must return a LaunchDescription containing exactly one "
            f"ReadyToTest action, found {len(actions)}"
        )
    return actions[0]


def iterate_ready_to_test_actions(
    entities: Iterable[LaunchDescriptionEntity],
) -> Iterator[ReadyToTest]:
    """Yield all ``ReadyToTest`` actions among entities and what they contain."""
    for entity in entities:
        if isinstance(entity, ReadyToTest):
            yield entity
        yield from iterate_ready_to_test_actions(entity.describe_sub_entities())
        for _, group in entity.describe_conditional_sub_entities():
            yield from iterate_ready_to_test_actions(group)


# which tests


def is_launch_test(item: Any) -> bool:
    """Return True if an item is marked ``launch``."""
    return item.get_closest_marker("launch") is not None


def is_launch_test_mark_valid(item: Any) -> bool:
    """Return True if the mark of an item names a launch fixture."""
    return _options(item) is not None


def get_launch_test_fixture(item: Any) -> Any:
    """Return the fixture that the mark of an item names, or None."""
    mark = item.get_closest_marker("launch")
    return None if mark is None else mark.kwargs.get("fixture")


def get_launch_test_fixture_scope(fixture: Any) -> str | None:
    """Return pytest's scope of a launch fixture; None for another function."""
    options: FixtureOptions | None = getattr(fixture, "_launch_pytest", None)
    return None if options is None else options.scope


def get_launch_test_fixturename(item: Any) -> str | None:
    """Return the name by which pytest knows that fixture, or None."""
    options = _options(item)
    return None if options is None else options.name


def is_same_launch_test_fixture(left_item: Any, right_item: Any) -> bool:
    """Return True if two items are tests of one launch fixture."""
    left = get_launch_test_fixture(left_item)
    return left is not None and left is get_launch_test_fixture(right_item)


def has_shutdown_kwarg(item: Any) -> bool:
    """Return True if the mark of an item says that it runs after the shutdown."""
    mark = item.get_closest_marker("launch")
    return mark is not None and bool(mark.kwargs.get("shutdown", False))


def is_shutdown_test(item: Any) -> bool:
    """Return True if an item runs after the shutdown: by its mark, or as the end of a generator."""
    return has_shutdown_kwarg(item) or getattr(item, "_launch_pytest_is_shutdown", False)


def need_shutdown_test_item(obj: Any) -> bool:
    """Return True if a test function is a generator, which resumes after the shutdown."""
    return inspect.isgeneratorfunction(obj) or inspect.isasyncgenfunction(obj)


def is_valid_test_item(obj: Any) -> bool:
    """Return True if something is a function, coroutine function or generator function."""
    return inspect.isfunction(obj) or inspect.ismethod(obj)


def _options(item: Any) -> FixtureOptions | None:
    found: FixtureOptions | None = getattr(get_launch_test_fixture(item), "_launch_pytest", None)
    return found


# collection


@pytest.hookimpl(tryfirst=True)
def pytest_pycollect_makeitem(collector: Any, name: str, obj: Any) -> list[pytest.Item] | None:
    """Make the items of a test that is marked ``launch``."""
    function = getattr(obj, "__func__", obj)
    if not is_valid_test_item(function) or not collector.istestfunction(obj, name):
        return None
    marks = [
        mark
        for mark in (*getattr(function, "pytestmark", []), *collector.iter_markers())
        if mark.name == "launch"
    ]
    if not marks:
        return None
    options: FixtureOptions | None = getattr(marks[0].kwargs.get("fixture"), "_launch_pytest", None)
    if options is None:
        pytest.fail(
            f"{name}: @pytest.mark.launch needs fixture=…, a function decorated with "
            "@launch_pytest.fixture",
            pytrace=False,
        )
    runs_at_end = bool(marks[0].kwargs.get("shutdown"))
    generate = functools.partial(generate_test_items, collector, name, function, options.name)
    items = generate(is_shutdown=runs_at_end, needs_renaming=False)
    if not need_shutdown_test_item(function):
        return items
    if runs_at_end:
        pytest.fail(f"{name}: a generator cannot be a shutdown test", pytrace=False)
    # Then the launch ends with this item, which also runs the end of the generator.
    if options.scope == "function":
        return items
    ends: list[Any] = generate(is_shutdown=True, needs_renaming=True)
    for begin, end in zip(items, ends, strict=True):
        end._launch_pytest_begin = begin
    return items + ends


def generate_test_items(
    collector: Any,
    name: str,
    obj: Callable[..., Any],
    fixturename: str,
    *,
    is_shutdown: bool,
    needs_renaming: bool,
) -> list[pytest.Item]:
    """Return the items of a test, one for each of its parameters.

    Args:
        collector: The module or class of the test.
        name: Name of the test.
        obj: The test, which gets the fixtures of the launch.
        fixturename: Name of the launch fixture.
        is_shutdown: Whether the items run after the shutdown of the launch.
        needs_renaming: Whether the names of the items say that.
    """
    needed = pytest.mark.usefixtures("event_loop", "launch_service", fixturename)
    items: list[Any] = list(collector._genfunctions(name, needed(obj)))
    if needs_renaming:
        items = [_renamed(item) for item in items]
    for item in items:
        item._launch_pytest_is_shutdown = is_shutdown
    return items


def _renamed(item: Any) -> Any:
    return from_parent(
        pytest.Function,
        item.parent,
        name=item.originalname + _SUFFIX,
        callobj=item.obj,
        callspec=getattr(item, "callspec", None),
        fixtureinfo=item._fixtureinfo,
    )


def from_parent(cls: type[Any], *args: Any, **kwargs: Any) -> Any:
    """Return a node of pytest, made by the ``from_parent`` of its class."""
    return cls.from_parent(*args, **kwargs)


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(
    session: pytest.Session, config: pytest.Config, items: list[pytest.Item]
) -> None:
    """Put the tests that run after the shutdown after all other tests of their launch."""
    del session, config
    places: dict[Any, list[int]] = {}
    for place, item in enumerate(items):
        if is_launch_test(item) and (options := _options(item)) is not None:
            places.setdefault(_launch_of(item, options), []).append(place)
    for group in places.values():
        # A stable sort, so the other tests keep their order.
        ordered = sorted((items[place] for place in group), key=is_shutdown_test)
        for place, item in zip(group, ordered, strict=True):
            items[place] = item


def _launch_of(item: Any, options: FixtureOptions) -> Any:
    """Return the key of an item's launch: fixture, scope and parameters."""
    scopes = {"class": pytest.Class, "module": pytest.Module, "package": pytest.Package}
    place = item if options.scope == "function" else item.session
    if options.scope in scopes:
        place = item.getparent(scopes[options.scope]) or item.getparent(pytest.Module)
    indices = getattr(getattr(item, "callspec", None), "indices", {})
    return options.name, place, indices.get(options.name)


# running tests


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: Any) -> bool | None:
    """Run a test that is marked ``launch`` while the loop of its launch runs."""
    options = _options(pyfuncitem)
    if options is None:
        return None
    names = pyfuncitem._fixtureinfo.argnames
    arguments = {name: pyfuncitem.funcargs[name] for name in names}
    loop = pyfuncitem.funcargs["event_loop"]
    shut_down = functools.partial(
        finalize_launch_service,
        pyfuncitem.funcargs["launch_service"],
        eprefix=f"When running test {pyfuncitem.name}: ",
        auto_shutdown=options.auto_shutdown,
    )
    function = pyfuncitem.obj
    if hasattr(pyfuncitem, "_launch_pytest_begin"):
        _finish(pyfuncitem._launch_pytest_begin, shut_down)
    elif need_shutdown_test_item(function):
        if options.scope == "function":
            wrap_generator_fscope(function, loop, shut_down)(**arguments)
        else:
            begin, pyfuncitem._launch_pytest_end = wrap_generator(function, loop, shut_down)
            begin(**arguments)
    else:
        wrap = wrap_coroutine if inspect.iscoroutinefunction(function) else wrap_func
        before_test = shut_down if has_shutdown_kwarg(pyfuncitem) else None
        wrap(function, loop, before_test)(**arguments)
    return True


def _finish(begin: Any, shut_down: Callable[[], None]) -> None:
    """Run the part of a generator that follows its ``yield``; ``begin`` is the item before."""
    end = getattr(begin, "_launch_pytest_end", None)
    if end is None:  # the item before was left out, or failed in its fixtures
        shut_down()
        pytest.skip(f"{begin.name} did not reach its yield")
    end()
