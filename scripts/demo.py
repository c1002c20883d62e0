"""What scripts/demo does once .venv is there: runs the tutorial's launch file and says what a person needs to know."""

from __future__ import annotations

import signal

if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # nothing runs yet that would have to be stopped

import argparse
import math
import os
import subprocess
import sys
import threading
import time
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from turtlewire.errors import WireError
from turtlewire.wire import environment

if TYPE_CHECKING:
    from collections.abc import Iterator

    from turtlewire import Buffer

VENV = Path(sys.prefix)
COMMAND = ("ros2", "launch", "learning_tf2_py", "turtle_tf2_demo.launch.py")
LEADER, FOLLOWER = "turtle1", "turtle2"
ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def main() -> int:
    """Run the demo or the check; the exit status."""
    parser = argparse.ArgumentParser(
        prog="scripts/demo",
        description="One turtle follows another: the tutorial's launch file, ready to run.",
    )
    mode = parser.add_mutually_exclusive_group()
    mode.add_argument("--seconds", type=seconds, help="end by itself after so many seconds")
    mode.add_argument(
        "--check",
        action="store_true",
        help="run headless, drive turtle1 through a square, print figures; status 0 if turtle2 followed",
    )
    arguments = parser.parse_args()
    started = float(os.environ.get("TURTLEWIRE_DEMO_STARTED", "").replace(",", ".") or time.time())
    prepare_environment()
    choose_core()
    from demo_check import check

    for signum in ENDING:
        signal.signal(signum, interrupt)
    return check(started) if arguments.check else show(arguments.seconds)


def seconds(text: str) -> float:
    """A time that can be waited for."""
    value = float(text)
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError(
            f"{text} is not a time to wait for; give a positive number"
        )
    return value


def prepare_environment() -> None:
    """Set what the launched processes inherit: nothing of a real ROS 2 that was sourced, and no place to write to outside of .venv."""
    os.environ["PATH"] = f"{VENV / 'bin'}{os.pathsep}{os.environ['PATH']}"
    os.environ.setdefault("ROS_LOG_DIR", str(VENV / "log"))
    for name in ("PYTHONPATH", "AMENT_PREFIX_PATH"):
        os.environ.pop(name, None)


def choose_core() -> None:
    """Say once, instead of in each process, that the compiled core is missing; the plain-Python one does the same."""
    if "TURTLEWIRE_CORE" not in os.environ and find_spec("turtlewire._native") is None:
        os.environ["TURTLEWIRE_CORE"] = "python"
        print(
            "[demo] transforms run on the plain-Python core; `apt install g++ python3-dev` (or the like) brings the compiled one"
        )


def interrupt(_signum: int, _frame: object) -> NoReturn:
    """End as after Ctrl-C."""
    raise KeyboardInterrupt


@contextmanager
def held_back() -> Iterator[None]:
    """Let Ctrl-C and its like wait for the end of the block."""
    came: list[int] = []
    handlers = {
        signum: signal.signal(signum, lambda number, _frame: came.append(number))
        for signum in ENDING
    }
    yield
    for signum, handler in handlers.items():
        signal.signal(signum, handler)
    if came:
        raise KeyboardInterrupt


class Launch:
    """The launched processes. They have a session of their own: Ctrl-C reaches only this process, which then stops them in order.

    Args:
        output: File that gets what they print; None lets them print here.
    """

    def __init__(self, output: int | None = None) -> None:
        self.ended = threading.Event()
        self._output = output
        self._process: subprocess.Popen[bytes] | None = None
        self._waiter = threading.Thread(target=self._wait, name="launch-waiter", daemon=True)

    def start(self) -> None:
        """Start them; `stop` is to be called whatever happens."""
        command = [str(VENV / "bin" / COMMAND[0]), *COMMAND[1:]]
        with held_back():  # a process that nobody knows of yet could not be stopped
            # without a terminal as its input, the launch tells its processes to end itself, instead
            # of leaving that to the terminal
            self._process = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=self._output,
                stderr=self._output,
                start_new_session=True,
            )
            self._waiter.start()

    def _wait(self) -> None:
        if self._process is not None:
            self._process.wait()
        self.ended.set()

    def stop(self) -> int:
        """Ask them to end, as Ctrl-C does, and kill what has not ended after ten seconds.

        Returns:
            0, or the exit status of a launch that had ended by itself.
        """
        for signum in ENDING:
            signal.signal(signum, signal.SIG_IGN)
        if self._process is None:
            return 0
        status = self._process.returncode if self.ended.is_set() else 0
        if not self.ended.is_set():
            self._process.send_signal(signal.SIGINT)
        if not self.ended.wait(10.0):
            print(
                "[demo] not all processes ended when they were asked to: killing them",
                file=sys.stderr,
            )
            os.killpg(self._process.pid, signal.SIGKILL)
        self._waiter.join()
        return status


def show(seconds: float | None) -> int:
    """Run the demo for a person, until Ctrl-C or for some seconds."""
    greet()
    deadline = time.monotonic() + seconds if seconds is not None else float("inf")
    launch = Launch()
    try:
        launch.start()
        from turtlesim.screen import desktop_is_there

        if desktop_is_there():
            launch.ended.wait(None if seconds is None else seconds)
        else:
            report_each_second(launch, deadline)
    except KeyboardInterrupt:
        pass
    finally:
        status = launch.stop()
    return status


def greet() -> None:
    """Say where this runs and what to type next."""
    discovery = environment.discovery()
    domain = environment.domain_id()
    reach = (
        "this computer only; ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET lets others in"
        if discovery.range.name == "LOCALHOST"
        else "others see it"
    )
    print(f"[demo] ROS domain {domain}, discovery range {discovery.range.name} ({reach})")
    print("[demo] drive turtle1 with the arrow keys, in the page or in a second terminal:")
    print(
        f"[demo]     export PATH={VENV / 'bin'}:$PATH"
        + (f" ROS_DOMAIN_ID={domain}" if domain else "")
    )
    print("[demo]     ros2 run turtlesim turtle_teleop_key")
    print("[demo] Ctrl-C ends it", flush=True)


def report_each_second(launch: Launch, deadline: float) -> None:
    """Print who follows whom until the launch or the time ends."""
    from turtlewire import Buffer
    from turtlewire.tf.listener import TransformListener

    buffer = Buffer()
    with TransformListener(buffer):
        while (
            not launch.ended.wait(max(0.0, min(1.0, deadline - time.monotonic())))
            and time.monotonic() < deadline
        ):
            print(f"[demo] {describe(buffer)}", flush=True)


def describe(buffer: Buffer) -> str:
    """Who follows whom, and how far away."""
    from turtlewire.errors import TransformException

    missing = [name for name in (LEADER, FOLLOWER) if not buffer.frame_exists(name)]
    if missing:
        return f"waiting for {' and '.join(missing)}"
    try:
        x, y, _ = buffer.lookup_transform(FOLLOWER, LEADER).translation
    except TransformException as error:
        return str(error)
    return f"{FOLLOWER} follows {LEADER}, {(x * x + y * y) ** 0.5:.2f} m away"


if __name__ == "__main__":
    try:
        sys.exit(main())
    except WireError as error:
        sys.exit(f"[demo] {error}\n[demo] {error.hint}")
    except KeyboardInterrupt:
        sys.exit(128 + signal.SIGINT)
