"""The implementation of scripts/demo: runs the tutorial's launch file, with hints."""

from __future__ import annotations

import signal

if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # until there are processes to stop

import os
import shlex
import sys
import time
from typing import TYPE_CHECKING

from demo_launch import ENDING, VENV, Launch, interrupt, other_demo_runs
from early_options import demo

from turtlewire.errors import WireError
from turtlewire.program import program
from turtlewire.wire import environment

if TYPE_CHECKING:
    from turtlewire import Buffer

LEADER, FOLLOWER = "turtle1", "turtle2"
#: Time between two lines that differ only in the distance [s].
_SAME_SITUATION_S = 10.0


def main() -> int:
    """Run the demo or the check; the exit status."""
    arguments = demo(sys.argv[1:])
    started = float(os.environ.get("TURTLEWIRE_DEMO_STARTED", "").replace(",", ".") or time.time())
    prepare_environment()
    from demo_check import check

    for signum in ENDING:
        signal.signal(signum, interrupt)
    return check(started) if arguments.check else show(arguments.seconds)


def prepare_environment() -> None:
    """Set what the launched processes inherit: no sourced ROS 2, and logs below .venv."""
    os.environ["PATH"] = f"{VENV / 'bin'}{os.pathsep}{os.environ['PATH']}"
    os.environ.setdefault("ROS_LOG_DIR", str(VENV / "log"))
    for name in ("PYTHONPATH", "AMENT_PREFIX_PATH"):
        os.environ.pop(name, None)


def show(seconds: float | None) -> int:
    """Run the demo for a person, until Ctrl-C or for some seconds."""
    deadline = time.monotonic() + seconds if seconds is not None else float("inf")
    launch = Launch()
    try:
        greet()
        launch.start()
        from turtlewire.web.desktop import desktop_is_there

        if desktop_is_there():
            launch.ended.wait(None if seconds is None else seconds)
        else:
            report_each_second(launch, deadline)
    except KeyboardInterrupt:
        pass
    finally:
        status = launch.stop()
    print("[demo] ended", flush=True)
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
    print(f"[demo]     source {shlex.quote(str(VENV / 'setup.bash'))}")
    if domain:
        print(f"[demo]     export ROS_DOMAIN_ID={domain}")
    print("[demo]     ros2 run turtlesim turtle_teleop_key")
    print("[demo] Ctrl-C ends it", flush=True)
    if other_demo_runs(domain):
        print(
            f"[demo] another demo runs in ROS domain {domain}: both drive the same turtles. "
            f"To keep them apart, end this one and type: ROS_DOMAIN_ID={domain + 1} scripts/demo",
            flush=True,
        )


def report_each_second(launch: Launch, deadline: float) -> None:
    """Print who follows whom, when that is news, until the launch or the time ends."""
    from turtlewire import Buffer
    from turtlewire.tf.listener import TransformListener

    buffer = Buffer()
    shown, shown_at = "", 0.0
    with TransformListener(buffer):
        while (
            not launch.ended.wait(max(0.0, min(1.0, deadline - time.monotonic())))
            and time.monotonic() < deadline
        ):
            text, now = describe(buffer), time.monotonic()
            if is_news(text, shown, now - shown_at):
                print(f"[demo] {text}", flush=True)
                shown, shown_at = text, now


def is_news(text: str, shown: str, age_s: float) -> bool:
    """Return whether a status is worth a line after the previous one.

    A new situation is, at once; a new distance is after ten seconds.
    """
    situation, before = (status.partition(",")[0] for status in (text, shown))
    return situation != before or (text != shown and age_s >= _SAME_SITUATION_S)


def describe(buffer: Buffer) -> str:
    """Describe which turtle follows which, and at what distance."""
    from turtlewire.errors import TransformException

    missing = [name for name in (LEADER, FOLLOWER) if name not in buffer]
    if missing:
        return f"waiting for {' and '.join(missing)}"
    try:
        x, y, _ = buffer.lookup_transform(FOLLOWER, LEADER).translation
    except TransformException as error:
        return str(error)
    return f"{FOLLOWER} follows {LEADER}, {(x * x + y * y) ** 0.5:.2f} m away"


if __name__ == "__main__":
    try:
        sys.exit(program(main)())
    except WireError as error:
        sys.exit(f"[demo] {error}\n[demo] {error.hint}")
    except KeyboardInterrupt:
        sys.exit(128 + signal.SIGINT)
