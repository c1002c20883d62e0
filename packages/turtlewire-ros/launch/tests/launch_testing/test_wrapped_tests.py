"""Functions of `launch_pytest.plugin` that make tests run while a loop runs, and pytest's hooks."""

import asyncio
import subprocess
import sys
import threading

import pytest

from launch_pytest.plugin import (
    from_parent,
    generate_test_items,
    is_shutdown_test,
    wrap_asyncgen,
    wrap_asyncgen_fscope,
    wrap_coroutine,
    wrap_func,
    wrap_generator,
    wrap_generator_fscope,
)
from launch_testing.pytest.hooks import (
    LaunchTestModule,
    pytest_addhooks,
    pytest_addoption,
    pytest_configure,
)


@pytest.fixture
def loop():
    loop = asyncio.new_event_loop()
    yield loop
    loop.run_until_complete(loop.shutdown_default_executor())
    loop.close()


@pytest.fixture
def calls():
    return []


def test_a_function_runs_while_the_loop_runs(loop, calls):
    ticked = threading.Event()

    def blocks(word):
        loop.call_soon_threadsafe(ticked.set)
        assert ticked.wait(60)
        calls.append(word)

    wrap_func(blocks, loop, lambda: calls.append("before"))(word="blocks")
    wrap_func(blocks, loop, None)(word="again")
    assert calls == ["before", "blocks", "again"]
    assert wrap_func(blocks, loop, None).__name__ == "blocks"


def test_a_coroutine_runs_on_the_loop(loop, calls):
    async def test(word):
        assert asyncio.get_running_loop() is loop
        calls.append(word)

    wrap_coroutine(test, loop, lambda: calls.append("before"))(word="runs")
    assert calls == ["before", "runs"]


def test_errors_are_raised(loop):
    async def fails():
        raise ValueError("of the test")

    with pytest.raises(ValueError, match="of the test"):
        wrap_coroutine(fails, loop, None)()
    with pytest.raises(ZeroDivisionError):
        wrap_func(lambda: 1 / 0, loop, None)()


def generator(calls, yields=1):
    def test(word):
        calls.append(word)
        for _ in range(yields):
            yield
        calls.append("after")

    async def async_test(word):
        calls.append(word)
        for _ in range(yields):
            yield
        calls.append("after")

    return [(test, wrap_generator), (async_test, wrap_asyncgen)]


@pytest.mark.parametrize("kind", [0, 1])
def test_a_generator_becomes_two_tests(loop, calls, kind):
    function, wrap = generator(calls)[kind]
    begin, end = wrap(function, loop, lambda: calls.append("shutdown"))
    begin(word="before")
    assert calls == ["before"]
    end()
    assert calls == ["before", "shutdown", "after"]


@pytest.mark.parametrize("kind", [0, 1])
def test_the_end_of_a_generator_that_did_not_begin_is_skipped(loop, calls, kind):
    function, wrap = generator(calls)[kind]
    _, end = wrap(function, loop, lambda: calls.append("shutdown"))
    with pytest.raises(pytest.skip.Exception, match="did not reach its yield"):
        end()
    assert calls == ["shutdown"]


@pytest.mark.parametrize("kind", [0, 1])
def test_a_generator_has_one_yield(loop, calls, kind):
    function, wrap = generator(calls, yields=2)[kind]
    begin, end = wrap(function, loop, list)
    begin(word="before")
    with pytest.raises(pytest.fail.Exception, match="has more than one yield"):
        end()
    function, wrap = generator(calls, yields=0)[kind]
    begin, _ = wrap(function, loop, list)
    with pytest.raises(pytest.fail.Exception, match="did not yield"):
        begin(word="before")


@pytest.mark.parametrize(("kind", "wrap"), [(0, wrap_generator_fscope), (1, wrap_asyncgen_fscope)])
def test_a_generator_becomes_one_test(loop, calls, kind, wrap):
    function, _ = generator(calls)[kind]
    wrap(function, loop, lambda: calls.append("shutdown"))(word="before")
    assert calls == ["before", "shutdown", "after"]


def test_hooks_that_come_twice_do_nothing(pytestconfig):
    markers = list(pytestconfig.getini("markers"))
    pytest_configure(pytestconfig)
    pytest_addhooks(pytestconfig.pluginmanager)
    pytest_addoption(pytestconfig._parser)
    assert pytestconfig.getini("markers") == markers
    assert pytestconfig.getoption("--launch-args") == []


def test_the_hooks_alone_are_a_plugin(tmp_path):
    (tmp_path / "test_some.py").write_text("def test_some(request):\n    pass\n")
    words = ("-p", "no:launch_testing", "-p", "launch_testing.pytest.hooks", "--markers")
    done = subprocess.run(
        [sys.executable, "-m", "pytest", *words],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "@pytest.mark.launch_test: " in done.stdout


@pytest.mark.parametrize("is_shutdown", [False, True])
def test_items_of_a_test(request, monkeypatch, is_shutdown):
    def test_some():
        pass

    module = request.node.getparent(pytest.Module)
    monkeypatch.setattr(module.obj, "test_some", test_some, raising=False)
    (item,) = generate_test_items(
        module, "test_some", test_some, "tmp_path", is_shutdown=is_shutdown, needs_renaming=True
    )
    assert item.name == "test_some[shutdown_test]"
    assert item.nodeid.endswith("::test_some[shutdown_test]")
    assert is_shutdown_test(item) is is_shutdown
    (mark,) = item.iter_markers("usefixtures")
    assert mark.args == ("event_loop", "launch_service", "tmp_path")


def test_a_module_of_a_plugin_for_ros_2(request, tmp_path):
    path = tmp_path / "test_some.py"
    made = LaunchTestModule.from_parent(parent=request.session, fspath=str(path))
    assert (type(made), made.path) == (LaunchTestModule, path)
    assert from_parent(LaunchTestModule, request.session, path=path).path == path
