"""Ctrl-C and SIGTERM beside asynchronous nodes, in separate processes."""

import signal

import pytest

SOURCE = """
    import asyncio, os, signal, sys, threading
    import rclpy
    from rclpy.experimental import AsyncNode

    where, sender = sys.argv[1:]

    def say(*words):
        # One write, so that lines of two threads do not mix.
        sys.stdout.write(" ".join(map(str, words)) + "\\n")

    async def main():
        if where == "inside":
            rclpy.init()
        node = AsyncNode("tested")

        async def tick():
            say("up")
            if sender == "callback":
                os.kill(os.getpid(), signal.SIGINT)
            try:
                await asyncio.Event().wait()
            except asyncio.CancelledError:
                say("callback cancelled")
                raise

        node.create_timer(0.0, tick)
        try:
            await node.run()
            say("run() returned", rclpy.ok())
        except asyncio.CancelledError:
            say("main cancelled")
            raise

    try:
        if where == "before":
            rclpy.init()
        if where == "thread":
            rclpy.init()
            ended = threading.Event()
            threading.Thread(target=lambda: (asyncio.run(main()), ended.set())).start()
            ended.wait()
        else:
            asyncio.run(main())
    except KeyboardInterrupt:
        say("interrupted")
    if where == "thread":
        ended.wait()
    rclpy.try_shutdown()
"""


@pytest.fixture
def start(program, monkeypatch):
    def start(where, sender="other process", middleware="local"):
        monkeypatch.setenv("RMW_IMPLEMENTATION", middleware)
        started = program(SOURCE, where, sender)
        assert started.read_line() == "up"
        return started

    return start


@pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])
@pytest.mark.parametrize("where", ["before", "inside"])
def test_ctrl_c_cancels_the_main_task_and_the_callbacks(start, where, middleware):
    program = start(where, middleware=middleware)
    program.send_signal(signal.SIGINT)
    assert program.finish() == (0, "callback cancelled\nmain cancelled\ninterrupted\n", "")


@pytest.mark.parametrize("where", ["before", "inside"])
def test_ctrl_c_while_a_callback_computes(start, where):
    program = start(where, "callback")
    assert program.finish() == (0, "callback cancelled\nmain cancelled\ninterrupted\n", "")


@pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])
@pytest.mark.parametrize("where", ["before", "inside", "thread"])
def test_sigterm_ends_run(start, where, middleware):
    """In ROS 2 nothing wakes the loop: the node, and a launch file's shutdown, hang."""
    program = start(where, middleware=middleware)
    program.send_signal(signal.SIGTERM)
    assert program.finish() == (0, "callback cancelled\nrun() returned False\n", "")


def test_ctrl_c_ends_a_node_in_another_thread(start):
    program = start("thread")
    program.send_signal(signal.SIGINT)
    status, output, errors = program.finish()
    expected = ["callback cancelled", "interrupted", "run() returned False"]
    assert (status, sorted(output.splitlines()), errors) == (0, expected, "")


def test_a_signal_before_the_node_runs(program, monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    source = """
    import asyncio, os, signal
    import rclpy
    from rclpy.experimental import AsyncNode

    rclpy.init()
    ended = asyncio.Event()
    node = AsyncNode("tested")
    context = node.context
    os.kill(os.getpid(), signal.SIGTERM)
    context.wait_for_graph(lambda: not context.ok(), None)
    node.create_timer(1.0, print)
    asyncio.run(node.run())
    print("run() returned")
    """
    assert program(source).finish() == (0, "run() returned\n", "")
