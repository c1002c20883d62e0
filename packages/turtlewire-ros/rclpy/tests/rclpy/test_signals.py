"""Ctrl-C and SIGTERM, in separate processes."""

import os
import re
import signal
import subprocess
import sys

import pytest
from tests.needs import needs_cyclone_dds
from tests.programs import run_python

TUTORIAL_MAIN = """
import rclpy
from rclpy.node import Node

def main():
    rclpy.init()
    node = Node("tested")
    node.create_guard_condition(lambda: print("up")).trigger()
    node.create_timer(0.01, lambda: None)
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        print("interrupted")
    finally:
        node.destroy_node()
        rclpy.shutdown()
    print("end")

main()
"""

MODES = pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])


@pytest.fixture
def start(program, monkeypatch):
    def start(source, middleware="local"):
        monkeypatch.setenv("RMW_IMPLEMENTATION", middleware)
        started = program(source)
        assert started.read_line() == "up"
        return started

    return start


@MODES
@pytest.mark.parametrize("times", [1, 2, 5])
def test_ctrl_c_ends_the_tutorials_main_cleanly(start, middleware, times):
    """A terminal and `ros2 launch` both send SIGINT, so several come at once."""
    program = start(TUTORIAL_MAIN, middleware)
    for _ in range(times):
        program.send_signal(signal.SIGINT)
    assert program.finish() == (0, "interrupted\nend\n", "")


@MODES
def test_sigterm_leaves_spin_as_an_external_shutdown(start, middleware):
    program = start(
        """
        import rclpy
        from rclpy.executors import ExternalShutdownException
        rclpy.init()
        node = rclpy.create_node("tested")
        node.create_guard_condition(lambda: print("up")).trigger()
        try:
            rclpy.spin(node)
        except ExternalShutdownException:
            print("shut down", rclpy.ok())
        rclpy.try_shutdown()
        """,
        middleware,
    )
    program.send_signal(signal.SIGTERM)
    assert program.finish() == (0, "shut down False\n", "")


def test_sigterm_that_is_not_caught_ends_the_process_with_a_traceback(start):
    program = start(
        "import rclpy\nrclpy.init()\nnode = "
        "rclpy.create_node('tested')\nprint('up')\nrclpy.spin(node)"
    )
    program.send_signal(signal.SIGTERM)
    status, _, errors = program.finish()
    assert status == 1
    assert errors.splitlines()[-1].startswith("rclpy.executors.ExternalShutdownException")


@MODES
def test_a_callback_can_publish_after_a_signal(start, middleware):
    program = start(
        """
        import threading, rclpy
        from std_msgs.msg import String
        rclpy.init()
        node = rclpy.create_node("tested")
        publisher = node.create_publisher(String, "topic", 1)
        shut = threading.Event()
        node.context.on_shutdown(shut.set)
        def callback():
            print("up")
            shut.wait()
            publisher.publish(String(data="last words"))
            node.create_publisher(String, "other", 1).publish(String())
            print("said")
        node.create_guard_condition(callback).trigger()
        try:
            rclpy.spin(node)
        except rclpy.executors.ExternalShutdownException:
            rclpy.shutdown()
        try:
            publisher.publish(String())
        except rclpy._rclpy_pybind11.RCLError as error:
            print(error)
        """,
        middleware,
    )
    program.send_signal(signal.SIGTERM)
    assert program.finish() == (0, "said\nFailed to publish: publisher's context is invalid\n", "")


def test_one_shutdown_after_a_signal_is_tolerated_and_a_second_raises(start):
    program = start("""
        import rclpy
        rclpy.init()
        context = rclpy.get_default_context()
        node = rclpy.create_node("tested")
        context.on_shutdown(lambda: print("told"))
        node.create_guard_condition(lambda: print("up")).trigger()
        try:
            rclpy.spin(node)
        except rclpy.executors.ExternalShutdownException:
            pass
        rclpy.shutdown()
        for again in (rclpy.shutdown, context.shutdown):
            try:
                again()
            except RuntimeError as error:
                print(type(error).__name__)
        rclpy.init()
        print(rclpy.ok())
        """)
    program.send_signal(signal.SIGTERM)
    assert program.finish() == (0, "told\nRuntimeError\nRCLError\nTrue\n", "")


@MODES
def test_ctrl_c_ends_spin_although_a_shutdown_callback_raises(start, middleware):
    program = start(
        """
        import rclpy
        rclpy.init()
        def fail():
            raise ValueError("no goodbye")
        rclpy.get_default_context().on_shutdown(fail)  # before the executor's own callback
        node = rclpy.create_node("tested")
        node.create_guard_condition(lambda: print("up")).trigger()
        try:
            rclpy.spin(node)
        except KeyboardInterrupt:
            print("interrupted")
        """,
        middleware,
    )
    program.send_signal(signal.SIGINT)
    status, printed, errors = program.finish()
    assert (status, printed) == (0, "interrupted\n")
    assert errors.count("ValueError: no goodbye\n") == 1


AFTER_ASYNCIO = """
import asyncio, signal, rclpy
rclpy.init()
async def handle_signals():
    for signum in (signal.SIGINT, signal.SIGTERM):
        asyncio.get_running_loop().add_signal_handler(signum, print, "never")
asyncio.run(handle_signals())
node = rclpy.create_node("tested")
node.create_guard_condition(lambda: print("up")).trigger()
try:
    rclpy.spin(node)
except (KeyboardInterrupt, rclpy.executors.ExternalShutdownException) as error:
    print(type(error).__name__)
"""


@MODES
@pytest.mark.parametrize(
    ("signum", "ending"),
    [(signal.SIGINT, "KeyboardInterrupt"), (signal.SIGTERM, "ExternalShutdownException")],
)
@pytest.mark.parametrize("endless", ["rclpy.spin(node)", "while True: rclpy.spin_once(node)"])
def test_signals_end_spin_after_asyncio_handled_them(start, middleware, signum, ending, endless):
    program = start(AFTER_ASYNCIO.replace("rclpy.spin(node)", endless), middleware)
    program.send_signal(signum)
    assert program.finish() == (0, f"{ending}\n", "")


def test_signals_within_a_loop_that_handles_them_reach_both(start):
    program = start(
        """
        import asyncio, signal, rclpy
        rclpy.init()
        node = rclpy.create_node("tested")
        node.create_guard_condition(lambda: print("up")).trigger()
        async def main():
            handled = asyncio.Event()
            asyncio.get_running_loop().add_signal_handler(signal.SIGINT, handled.set)
            try:
                rclpy.spin(node)
            except rclpy.executors.ExternalShutdownException:
                print("shut down")
            await handled.wait()
            print("handled")
        asyncio.run(main())
        """
    )
    program.send_signal(signal.SIGINT)
    assert program.finish() == (0, "shut down\nhandled\n", "")


def test_a_loop_that_calls_spin_once_keeps_its_signals(start):
    program = start(
        """
        import asyncio, signal, rclpy
        rclpy.init()
        node = rclpy.create_node("tested")
        async def main():
            asyncio.get_running_loop().add_signal_handler(signal.SIGTERM, print)
            owner = signal.set_wakeup_fd(-1)
            signal.set_wakeup_fd(owner)
            rclpy.spin_once(node, timeout_sec=0)
            print("up")
            print(signal.set_wakeup_fd(owner) == owner)
        asyncio.run(main())
        """
    )
    assert program.finish() == (0, "True\n", "")


def test_the_descriptor_of_a_loop_that_has_ended_is_not_restored(start):
    program = start(
        """
        import asyncio, signal, rclpy
        async def main():
            asyncio.get_running_loop().add_signal_handler(signal.SIGINT, print)
            rclpy.init()
        asyncio.run(main())
        rclpy.shutdown()
        print("up")
        print(signal.set_wakeup_fd(-1))
        """
    )
    assert program.finish() == (0, "-1\n", "")


def test_ctrl_c_reaches_executors_of_other_threads(start):
    program = start("""
        import threading, rclpy
        from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
        rclpy.init()
        node = rclpy.create_node("tested")
        executor = MultiThreadedExecutor(2)
        executor.add_node(node)
        ended = threading.Event()
        threading.Thread(target=lambda: (executor.spin(), ended.set())).start()
        try:
            print("up")
            ended.wait()
        except KeyboardInterrupt:
            print(ended.wait(60), rclpy.ok())
        node.destroy_node()
        rclpy.shutdown()
        """)
    program.send_signal(signal.SIGINT)
    assert program.finish() == (0, "True False\n", "")


def test_ctrl_c_in_the_middle_of_a_callback(start):
    program = start("""
        import threading, rclpy
        rclpy.init()
        node = rclpy.create_node("tested")
        def work():
            print("up")
            threading.Event().wait()
        node.create_timer(0.01, work)
        try:
            rclpy.spin(node)
        except KeyboardInterrupt:
            print("interrupted")
        node.destroy_node()
        rclpy.shutdown()
        """)
    program.send_signal(signal.SIGINT)
    assert program.finish() == (0, "interrupted\n", "")


@pytest.mark.parametrize(
    ("waiting", "after_sigterm"),
    [
        ("client.wait_for_service()", "RCLError"),
        ("node.wait_for_node('/nobody', float('inf'))", "RCLError"),
        ("client.call(Trigger.Request())", "ExternalShutdownException"),
    ],
)
def test_signals_end_waits_that_are_no_spin(start, waiting, after_sigterm):
    source = f"""
        import rclpy
        from std_srvs.srv import Trigger
        rclpy.init()
        node = rclpy.create_node("tested")
        client = node.create_client(Trigger, "nobody")
        # The encoder is made now: an interrupt in its exec() would decide CPython's exit status.
        client.call_async(Trigger.Request())
        try:
            print("up")
            print({waiting})
        except BaseException as error:
            print(type(error).__name__)
        rclpy.try_shutdown()
        """
    program = start(source)
    program.send_signal(signal.SIGINT)
    assert program.finish() == (0, "KeyboardInterrupt\n", "")
    program = start(source)
    program.send_signal(signal.SIGTERM)
    assert program.finish() == (0, f"{after_sigterm}\n", "")


def test_ctrl_c_that_is_not_caught_ends_without_a_traceback(start):
    program = start("""
        import threading, rclpy
        rclpy.init()
        node, other = rclpy.create_node("tested"), rclpy.create_node("other")
        executor = rclpy.executors.SingleThreadedExecutor()
        executor.add_node(other)
        threading.Thread(target=executor.spin).start()
        node.create_guard_condition(lambda: print("up")).trigger()
        rclpy.spin(node)
        """)
    program.send_signal(signal.SIGINT)
    assert program.finish() == (-signal.SIGINT, "", "")


def test_ctrl_c_between_two_callbacks_of_asyncio_loses_none(start):
    """The one that was next wakes a task: without it, asyncio.run waited for the task forever."""
    program = start('''
        import asyncio, rclpy

        # As part of asyncio's module: the signal meets asyncio's own code.
        exec('if 1:' + """
            import signal
            run, meets = Handle._run, True

            def interrupted_run(self):
                global meets
                if meets and "wakeup" in repr(self._callback):
                    meets = False
                    signal.raise_signal(signal.SIGINT)
                return run(self)
            """, vars(asyncio.events))

        async def main():
            woken = asyncio.get_running_loop().create_future()
            asyncio.get_running_loop().call_soon(woken.set_result, None)
            async def wait():
                await woken
                await asyncio.sleep(1e6)
            await wait()

        rclpy.init()
        print("up")
        asyncio.Handle._run = asyncio.events.interrupted_run
        try:
            asyncio.run(main())
        except KeyboardInterrupt:
            print("interrupted", asyncio.events.meets)
        ''')
    assert program.finish() == (0, "interrupted False\n", "")


def test_ctrl_c_in_a_coroutine_raises_there(start):
    """As a cell of a notebook is interrupted, which runs below the kernel's loop."""
    program = start("""
        import asyncio, signal, rclpy

        async def main():
            try:
                signal.raise_signal(signal.SIGINT)
                print("goes on")
            except KeyboardInterrupt:
                print("interrupted")

        rclpy.init()
        print("up")
        asyncio.run(main())
        """)
    assert program.finish() == (0, "interrupted\n", "")


def test_ctrl_c_while_a_program_still_imports_ends_without_a_traceback(start):
    program = start("import threading, rclpy\nprint('up')\nthreading.Event().wait()")
    program.send_signal(signal.SIGINT)
    assert program.finish() == (-signal.SIGINT, "", "")


INTERRUPTED_IMPORTS = """
import importlib, os, sys
from importlib.util import find_spec

OURS = ("rclpy", "turtlewire")
folders = tuple(os.path.dirname(find_spec(name).origin) for name in OURS)
called = {}

def place_of(frame):
    code = frame.f_code
    return code.co_filename, code.co_name, code.co_firstlineno

def note(frame, event, _):
    if event == "call" and frame.f_code.co_filename.startswith(folders):
        called.setdefault(place_of(frame))

def interrupt(place):
    def profile(frame, event, _):
        if event == "call" and place_of(frame) == place:
            raise KeyboardInterrupt
    return profile

def import_in_a_child(profile):
    reading, writing = os.pipe()
    if os.fork() == 0:
        outcome = "no exception"
        sys.setprofile(profile)
        try:
            import rclpy.node
        except BaseException as error:
            outcome = repr(error)
        sys.setprofile(None)
        others = [name for name in sys.modules if not name.startswith((*OURS, "_"))]
        os.write(writing, repr((list(called), others, outcome)).encode())
        os._exit(0)
    os.close(writing)
    with open(reading) as answer:
        text = answer.read()
    os.wait()
    return eval(text)

places, others, _ = import_in_a_child(note)
for name in others:  # so that the children need not import them again
    importlib.import_module(name)
functions = [place for place in places if place[1] != "<module>"]
for place in functions:
    *_, outcome = import_in_a_child(interrupt(place))
    if outcome != "KeyboardInterrupt()":
        print(place, outcome)
print(len(functions), "functions")
"""


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system cannot fork processes")
def test_ctrl_c_during_an_import_is_a_keyboard_interrupt():
    command = [sys.executable, "-c", INTERRUPTED_IMPORTS]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=600)
    (count,) = re.fullmatch(r"(\d+) functions\n", done.stdout).groups()
    assert int(count) > 100
    assert done.stderr == ""


def test_other_errors_keep_their_traceback(program):
    status, _, errors = program("import rclpy\nrclpy.init()\nraise LookupError('wrong')").finish()
    assert status == 1
    assert errors.splitlines()[-1] == "LookupError: wrong"


def test_a_handler_of_the_program_runs_as_well(start):
    program = start("""
        import signal, rclpy
        signal.signal(signal.SIGINT, lambda *_: print("mine"))
        signal.signal(signal.SIGTERM, lambda *_: print("mine too"))
        rclpy.init()
        node = rclpy.create_node("tested")
        node.create_guard_condition(lambda: print("up")).trigger()
        try:
            rclpy.spin(node)
        except rclpy.executors.ExternalShutdownException:
            print("shut down")
        rclpy.shutdown()
        print(signal.getsignal(signal.SIGTERM)(15, None))
        """)
    program.send_signal(signal.SIGINT)
    assert program.finish() == (0, "mine\nshut down\nmine too\nNone\n", "")


def test_signal_options(program):
    source = """
        import signal, rclpy
        from rclpy.signals import SignalHandlerOptions, get_current_signal_handlers_options
        before = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)]
        for options in SignalHandlerOptions:
            rclpy.init(signal_handler_options=options)
            now = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)]
            changed = [a is not b for a, b in zip(before, now)]
            print(get_current_signal_handlers_options().name, changed)
            rclpy.shutdown()
        print([signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)] == before)
        context = rclpy.Context()
        rclpy.init(context=context)
        print(get_current_signal_handlers_options().name)
        rclpy.shutdown(context=context)
        """
    expected = (
        "NO [False, False]\nSIGINT [True, False]\nSIGTERM [False, True]\nALL [True, "
        "True]\nTrue\nNO\n"
    )
    assert program(source).finish() == (0, expected, "")


def test_earlier_signal_watchers_are_still_notified(start):
    program = start("""
        import os, signal, rclpy
        read_end, write_end = os.pipe()
        os.set_blocking(write_end, False)
        signal.set_wakeup_fd(write_end)
        rclpy.init()
        node = rclpy.create_node("tested")
        node.create_guard_condition(lambda: print("up")).trigger()
        try:
            rclpy.spin(node)
        except KeyboardInterrupt:
            pass
        print(list(os.read(read_end, 8)) == [signal.SIGINT])
        rclpy.shutdown()
        print(signal.set_wakeup_fd(-1) == write_end)
        """)
    program.send_signal(signal.SIGINT)
    assert program.finish() == (0, "True\nTrue\n", "")


@pytest.mark.parametrize("begin", ["", "rclpy.init()"])
@pytest.mark.parametrize(
    ("body", "watched"), [("pass", "weakref.ref(it, interrupt)"), ("__del__ = interrupt", "None")]
)
def test_ctrl_c_where_python_drops_exceptions_comes_right_behind(start, begin, body, watched):
    """Each import ends with the callback of a weak reference; destructors are everywhere."""
    program = start(f"""
        import os, signal, time, weakref, rclpy
        {begin}
        print("up")
        def interrupt(_):
            os.kill(os.getpid(), signal.SIGINT)
        class It:
            {body}
        def work():  # in Python 3.13, `try` misses what is raised at the end of a loop in it
            end = time.monotonic() + 60
            while time.monotonic() < end:
                pass
        try:
            it = It()
            watched = {watched}
            del it
            work()
            print("lost")
        except KeyboardInterrupt:
            print("interrupted")
        """)
    status, output, errors = program.finish()
    assert (status, output.split(), errors) == (0, ["interrupted"], "")


def test_a_forked_child_does_not_shut_its_parent_down(start):
    program = start("""
        import os, signal, time, warnings, rclpy
        warnings.simplefilter("ignore", DeprecationWarning)  # Python 3.12: of fork() with threads
        rclpy.init()
        child = os.fork()
        if child == 0:
            time.sleep(60)
        os.kill(child, signal.SIGTERM)
        print("up")
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == -signal.SIGTERM, rclpy.ok())
        rclpy.shutdown()
        """)
    assert program.finish() == (0, "True True\n", "")


FORKS = """
import os, signal, threading, warnings

warnings.simplefilter("ignore", DeprecationWarning)  # Python 3.12: of fork() with threads
both = threading.Barrier(2)
os.register_at_fork(before=both.wait)  # runs after rclpy's function, which is registered later

import rclpy

def fork(blocked):
    signal.pthread_sigmask(signal.SIG_BLOCK, blocked)
    child = os.fork()
    if child == 0:
        os._exit(signal.pthread_sigmask(signal.SIG_BLOCK, ()) != blocked)
    same = signal.pthread_sigmask(signal.SIG_BLOCK, ()) == blocked
    print(os.waitpid(child, 0)[1] == 0 and same)

threads = [threading.Thread(target=fork, args=(mask,)) for mask in (set(), {signal.SIGUSR1})]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system cannot fork processes")
def test_threads_that_fork_at_once_keep_their_signal_masks():
    assert run_python(FORKS).stdout == "True\nTrue\n"


@needs_cyclone_dds
def test_a_program_that_never_shuts_down_ends(start):
    program = start(
        "import rclpy\nrclpy.init()\nnode = rclpy.create_node('tested')\nprint('up')",
        "rmw_cyclonedds_cpp",
    )
    assert program.finish() == (0, "", "")


LATE = """
import os, signal, sys, rclpy

class Last:
    def __del__(self, kill=os.kill, pid=os.getpid(), print=print):
        print("a second time", flush=True)
        kill(pid, signal.SIGINT)

last = Last()  # goes with the module, after Python has put the default handlers back
rclpy.init()
node = rclpy.create_node("n")
try:
    os.kill(os.getpid(), signal.Signals[sys.argv[1]])
    rclpy.spin(node)
except (KeyboardInterrupt, rclpy.executors.ExternalShutdownException):
    rclpy.shutdown()
os.kill(os.getpid(), signal.SIGINT)
"""


@pytest.mark.parametrize("first", ["SIGINT", "SIGTERM"])
def test_sigint_after_a_signal_does_not_kill_an_ending_process(first):
    """`ros2 launch` passes signals on to processes that the terminal or `timeout` told already."""
    done = run_python(LATE, first, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "a second time\n", "")


TUTORIAL_CLIENT = """
import rclpy
from rclpy.node import Node
from std_srvs.srv import Empty

rclpy.init()
node = Node("tested")
client = node.create_client(Empty, "of_nobody")
print("up")
while not client.wait_for_service(timeout_sec=1.0):
    node.get_logger().info("service not available, waiting again...")
"""


@MODES
def test_sigterm_ends_the_tutorials_client_that_waits_for_a_service(start, middleware):
    program = start(TUTORIAL_CLIENT, middleware)
    program.send_signal(signal.SIGTERM)
    status, _, errors = program.finish()
    assert status == 1
    assert errors.splitlines()[-1].endswith(
        "RCLError: failed to check service availability: rcl node's context is invalid"
    )


def test_a_guard_condition_of_signals(start):
    program = start(
        """
        import threading
        import rclpy
        from rclpy.signals import SignalHandlerGuardCondition
        rclpy.init()
        came = threading.Event()

        class Noted(SignalHandlerGuardCondition):
            def trigger(self):
                super().trigger()
                came.set()

        kept, destroyed = Noted(), Noted()
        destroyed.destroy()
        print("up")
        came.wait()
        print(kept._triggered, destroyed._triggered)
        """
    )
    program.send_signal(signal.SIGTERM)
    assert program.finish() == (0, "True False\n", "")
