"""Futures and tasks, on an executor and in asyncio."""

import asyncio
import gc
import sys
import threading
import types

import pytest

from rclpy.task import Future, Task


def test_a_result_can_be_read_once_it_is_there():
    future = Future()
    assert not future.done()
    assert future.result() is None
    future.set_result(3)
    assert future.done()
    assert future.result() == 3
    assert future.exception() is None


def test_an_exception_is_raised_by_result():
    future = Future()
    future.set_exception(ValueError("no"))
    assert future.done()
    assert isinstance(future.exception(), ValueError)
    with pytest.raises(ValueError, match="no"):
        future.result()


def test_an_exception_that_nobody_asks_for_is_printed(capsys):
    future = Future()
    future.set_exception(ValueError("lost"))
    del future
    gc.collect()
    assert capsys.readouterr().err == "The following exception was never retrieved: lost\n"


def test_cancelling_ends_a_future_and_a_later_cancel_does_nothing():
    called = []
    future = Future()
    future.add_done_callback(called.append)
    future.cancel()
    future.cancel()
    assert future.cancelled()
    assert future.done()
    assert called == [future]


def test_done_callbacks_run_inline_without_an_executor():
    called = []
    future = Future()
    future.add_done_callback(lambda done: called.append(("before", done.result())))
    future.set_result(1)
    future.add_done_callback(lambda done: called.append(("after", done.result())))
    assert called == [("before", 1), ("after", 1)]


def test_done_callbacks_are_called_once_though_another_result_follows():
    called = []
    future = Future()
    future.add_done_callback(called.append)
    future.set_result(1)
    assert not future.remove_done_callback(called.append)
    future.set_result(2)
    assert future.result() == 2
    assert called == [future]


def test_raising_done_callback_does_not_stop_the_others():
    called = []
    future = Future()
    future.add_done_callback(lambda _: 1 / 0)
    future.add_done_callback(called.append)
    with pytest.warns(UserWarning, match="Unhandled exception in done callback: division by zero"):
        future.set_result(None)
    assert called == [future]


def test_done_callbacks_can_be_removed():
    called = []
    future = Future()
    future.add_done_callback(called.append)
    assert future.remove_done_callback(called.append)
    assert not future.remove_done_callback(called.append)
    future.set_result(None)
    assert called == []


def test_a_future_may_be_done_after_the_loop_in_which_it_was_awaited():
    called = []
    future = Future()
    future.add_done_callback(called.append)

    async def give_up():
        async def wait():
            await future

        waiting = asyncio.create_task(wait())
        await asyncio.sleep(0)
        waiting.cancel()

    asyncio.run(give_up())
    future.set_result(1)
    assert future.result() == 1
    assert called == [future]


def test_a_task_runs_a_function():
    task = Task(lambda a, b: a - b, args=(5,), kwargs={"b": 2})
    task()
    assert task.result() == 3
    task()
    assert task.result() == 3


def test_a_task_keeps_the_exception_of_its_function():
    task = Task(lambda: 1 / 0)
    task()
    assert isinstance(task.exception(), ZeroDivisionError)


def test_a_task_stops_at_what_is_not_done_yet():
    future = Future()

    async def wait():
        return await future + 1

    task = Task(wait)
    task()
    assert not task.done()
    future.set_result(1)
    task()
    assert task.result() == 2


def test_cancelling_a_task_runs_the_finally_blocks_of_its_coroutine():
    steps = []

    async def wait():
        try:
            await Future()
        finally:
            steps.append("closed")

    task = Task(wait)
    task()
    task.cancel()
    assert steps == ["closed"]
    assert task.cancelled()


def test_tasks_wait_for_each_other_without_polling(executor):
    steps = []
    gate = Future(executor=executor)

    async def first():
        steps.append("first waits")
        steps.append(await gate)
        return "done"

    async def second():
        return await executor.create_task(first)

    task = executor.create_task(second)
    for _ in range(5):
        executor.spin_once(timeout_sec=0)
    assert steps == ["first waits"]
    assert executor._rclpy_scheduler._tasks == []
    gate.set_result("gate open")
    executor.spin_until_future_complete(task, timeout_sec=60)
    assert task.result() == "done"
    assert steps == ["first waits", "gate open"]


def test_a_bare_yield_runs_again_in_the_next_cycle(executor):
    class Pass:
        def __await__(self):
            yield

    async def three_steps():
        await Pass()
        await Pass()
        return "end"

    task = executor.create_task(three_steps)
    executor.spin_until_future_complete(task, timeout_sec=60)
    assert task.result() == "end"


def test_a_task_runs_while_another_thread_imports_asyncio(executor, monkeypatch):
    async def end():
        return "end"

    task = executor.create_task(end)
    with monkeypatch.context() as patch:
        patch.setitem(sys.modules, "asyncio", types.ModuleType("asyncio"))  # its first moment
        executor.spin_until_future_complete(task, timeout_sec=60)
    assert task.result() == "end"


@pytest.mark.parametrize(
    "make", [lambda executor: Future(executor=executor), lambda executor: executor.create_future()]
)
def test_done_callbacks_run_as_tasks_of_the_executor(executor, make):
    future = make(executor)
    threads = []
    future.add_done_callback(lambda _: threads.append(threading.current_thread()))
    setter = threading.Thread(target=future.set_result, args=(1,))
    setter.start()
    setter.join()
    assert threads == []
    executor.spin_once(timeout_sec=60)
    assert threads == [threading.current_thread()]


def test_an_exception_in_a_task_leaves_spin(executor):
    executor.create_task(lambda: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        executor.spin_once(timeout_sec=60)


async def test_a_future_can_be_awaited_in_asyncio():
    future = Future()

    setter = threading.Thread(target=future.set_result, args=("from a thread",))
    waiting = asyncio.ensure_future(_await(future))
    await asyncio.sleep(0)
    setter.start()
    result = await asyncio.wait_for(waiting, 60)
    setter.join()
    assert (result, await future) == ("from a thread", "from a thread")


async def _await(future):
    return await future


async def test_a_future_forgets_what_no_longer_awaits_it_in_asyncio():
    future = Future()

    async def forward():
        await future

    awaiting = asyncio.ensure_future(forward())
    await asyncio.sleep(0)
    assert len(future._waiters) == 1
    awaiting.cancel()
    with pytest.raises(asyncio.CancelledError):
        await awaiting
    assert future._waiters == []


def test_a_future_whose_construction_was_interrupted_is_forgotten_silently(capsys):
    Future.__new__(Future).__del__()
    assert capsys.readouterr() == ("", "")
