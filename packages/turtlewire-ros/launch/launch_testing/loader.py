"""Finds the tests of a module, and binds them to a launch."""

from __future__ import annotations

import functools
import inspect
import unittest
from collections.abc import Callable, Iterable, Iterator, Mapping
from types import ModuleType
from typing import TYPE_CHECKING, Any

from launch import LaunchDescription
from launch_testing.actions.ready import ReadyToTest

if TYPE_CHECKING:
    from launch.launch_description_entity import LaunchDescriptionEntity

_Description = tuple[LaunchDescription, dict[str, Any]]

_FIXTURES = ("setUp", "tearDown")
_CLASS_FIXTURES = ("setUpClass", "tearDownClass")


class TestRun:
    """One launch and its tests.

    Args:
        name: Its name in reports.
        test_description_function: Makes the launch description, or that and a mapping of objects
            for the tests.
        param_args: Its arguments from ``launch_testing.parametrize``.
        pre_shutdown_tests: Tests while the processes run.
        post_shutdown_tests: Tests when they have ended.
    """

    __test__ = False  # pytest does not collect it

    def __init__(
        self,
        name: str,
        test_description_function: Callable[..., Any],
        param_args: dict[str, Any],
        pre_shutdown_tests: unittest.TestSuite,
        post_shutdown_tests: unittest.TestSuite,
    ) -> None:
        self.name = name
        self.test_description_function = test_description_function
        self.param_args = param_args
        self.pre_shutdown_tests = pre_shutdown_tests
        self.post_shutdown_tests = post_shutdown_tests
        # A suite forgets each test when it has run.
        self._cases = [*_cases(pre_shutdown_tests), *_cases(post_shutdown_tests)]

    def __str__(self) -> str:
        arguments = ", ".join(f"{name}={value}" for name, value in self.param_args.items())
        return f"{self.name}[{arguments}]"

    @property
    def markers(self) -> Mapping[str, Any]:
        """Marks of the function that makes the description; ``keep_alive`` and ``timeout``."""
        marks: Mapping[str, Any] = getattr(self.test_description_function, "__markers__", {})
        return marks

    def all_cases(self) -> Iterator[unittest.TestCase]:
        """Yield all tests."""
        yield from self._cases

    def describe(self, ready_fn: Callable[[], object]) -> _Description:
        """Make the launch description.

        Args:
            ready_fn: Called when the tests may begin.

        Returns:
            The description, and objects for the tests.

        Raises:
            RuntimeError: The description has no ``ReadyToTest``.
            TypeError: The function returned something else.
        """
        function = self.test_description_function
        # ROS 2's former interface: the description calls the function itself.
        if "ready_fn" in inspect.signature(function).parameters:
            return _normalized(function(ready_fn=ready_fn), function)
        description, objects = _normalized(function(), function)
        action = next(_ready_actions(description.entities), None)
        if action is None:
            raise RuntimeError(
                f"{_name(function)} must return a LaunchDescription that contains a "
                "launch_testing.actions.ReadyToTest action"
            )
        action.add_callback(ready_fn)
        return description, objects

    def get_launch_description(self) -> LaunchDescription:
        """Make the launch description only to look at it."""
        return self.describe(lambda: None)[0]

    def bind(
        self,
        tests: unittest.TestSuite,
        injected_attributes: Mapping[str, Any] = {},
        injected_args: Mapping[str, Any] = {},
    ) -> None:
        """Give objects to tests.

        Args:
            tests: The tests.
            injected_attributes: They become attributes of the tests.
            injected_args: They become arguments of the tests, their ``setUp``, ``tearDown``,
                ``setUpClass`` and ``tearDownClass``, if these have parameters of that name.
        """
        cases = list(_cases(tests))
        for case in cases:
            vars(case).update(injected_attributes)
            for name in (case._testMethodName, *_FIXTURES):
                setattr(case, name, _bound(getattr(case, name), injected_args))
        for test_class in {type(case) for case in cases}:
            for name in _CLASS_FIXTURES:
                setattr(test_class, name, _bound(getattr(test_class, name), injected_args))


def LoadTestsFromPythonModule(  # noqa: N802  ROS 2's name
    module: ModuleType, *, name: str = "launch_tests"
) -> list[TestRun]:
    """Find the launches of a module: one, or one for each set of parameters.

    Args:
        module: Has a function ``generate_test_description``, and test cases of unittest.
        name: Names the runs in reports.
    """
    function = module.generate_test_description
    parametrized = getattr(function, "__parametrized__", False)
    return [
        TestRun(
            name,
            description,
            arguments,
            PreShutdownTestLoader().loadTestsFromModule(module),
            PostShutdownTestLoader().loadTestsFromModule(module),
        )
        for description, arguments in (function() if parametrized else [(function, {})])
    ]


def PreShutdownTestLoader() -> unittest.TestLoader:  # noqa: N802  ROS 2's name
    """Return a loader of tests that run while the processes run."""
    return _Loader(post_shutdown=False)


def PostShutdownTestLoader() -> unittest.TestLoader:  # noqa: N802  ROS 2's name
    """Return a loader of the tests of classes marked with ``post_shutdown_test``."""
    return _Loader(post_shutdown=True)


class _Loader(unittest.TestLoader):
    """Loads the tests of one kind of classes."""

    def __init__(self, *, post_shutdown: bool) -> None:
        super().__init__()
        self._post_shutdown = post_shutdown

    def loadTestsFromTestCase(  # noqa: N802  unittest's name
        self,
        testCaseClass: type[unittest.TestCase],  # noqa: N803  likewise
    ) -> unittest.TestSuite:
        """Return the tests of a class, or none."""
        if getattr(testCaseClass, "__post_shutdown_test__", False) != self._post_shutdown:
            return unittest.TestSuite()
        # A new class for each run, because `bind` changes it.
        own = type(testCaseClass.__name__, (testCaseClass,), {"__doc__": testCaseClass.__doc__})
        own.__module__ = testCaseClass.__module__
        own.__qualname__ = testCaseClass.__qualname__
        return super().loadTestsFromTestCase(own)


def _cases(tests: Iterable[Any]) -> Iterator[unittest.TestCase]:
    for test in tests:
        if isinstance(test, unittest.TestSuite):
            yield from _cases(test)
        else:
            yield test


def _bound(function: Callable[..., Any], objects: Mapping[str, Any]) -> Callable[..., Any]:
    names = set(inspect.signature(function).parameters) & set(objects)
    if not names:
        return function
    bound = functools.partial(function, **{name: objects[name] for name in names})
    return functools.update_wrapper(bound, function)


def _normalized(result: Any, function: Callable[..., Any]) -> _Description:
    description, objects = result if isinstance(result, tuple) else (result, {})
    if not isinstance(description, LaunchDescription):
        raise TypeError(
            f"{_name(function)} must return a LaunchDescription, "
            f"not {type(description).__name__} ({description!r})"
        )
    return description, objects


def _name(function: Callable[..., Any]) -> str:
    return getattr(function, "__name__", "generate_test_description")


def _ready_actions(entities: Iterable[LaunchDescriptionEntity]) -> Iterator[ReadyToTest]:
    for entity in entities:
        if isinstance(entity, ReadyToTest):
            yield entity
        yield from _ready_actions(entity.describe_sub_entities())
        for _, group in entity.describe_conditional_sub_entities():
            yield from _ready_actions(group)
