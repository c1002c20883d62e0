"""``python -m turtlewire.demo``: one turtle follows another, on every system and without bash.

It launches the tutorial's launch file with the packages that pip has installed. ``scripts/demo`` of
the sources does the same and sets them up first.
"""

from __future__ import annotations

import argparse
import os
import shlex
import subprocess
import sys
import sysconfig
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib.util import find_spec

from turtlewire.program import program

_LAUNCH = ("launch", "learning_tf2_py", "turtle_tf2_demo.launch.py")
#: Other packages that the demo needs, and their folders in the sources.
_NEEDED = {
    "turtlesim": "./packages/turtlewire-ros",
    "learning_tf2_py": "./examples/learning_tf2_py",
}
_PATIENCE_S = 20.0


def main(argv: list[str] | None = None) -> int:
    """Run the demo until Ctrl-C, or for some seconds.

    Returns:
        The exit status: that of the launch; 0 after Ctrl-C or the seconds; 1 if a package is
        missing.
    """
    parser = argparse.ArgumentParser(
        prog="python -m turtlewire.demo",
        description="One turtle follows another in the browser: the tutorial's launch file.",
        allow_abbrev=False,
    )
    parser.add_argument("--seconds", type=float, help="stop after this many seconds")
    seconds: float | None = parser.parse_args(argv).seconds
    if seconds is not None and not seconds > 0:
        parser.error(f"{seconds} is not a positive number of seconds")
    missing = [name for name in _NEEDED if find_spec(name) is None]
    if missing:
        paths = " ".join(_NEEDED[name] for name in missing)
        sys.stderr.write(
            f"[demo] not installed: {', '.join(missing)}\n"
            "[demo] in the folder of turtlewire's sources, type: "
            f"{_typed(sys.executable)} -m pip install {paths}\n"
        )
        return 1
    ros2 = _ros2()
    sys.stdout.write(
        "[demo] drive turtle1 with the arrow keys, in the page or in a second terminal:\n"
        f"[demo]     {_typed(ros2)} run turtlesim turtle_teleop_key\n"
        "[demo] Ctrl-C ends it\n"
    )
    sys.stdout.flush()
    return _run([ros2, *_LAUNCH], seconds)


def _typed(path: str) -> str:
    """Return a path as it is typed in a shell."""
    return path if sys.platform == "win32" else shlex.quote(path)


def _ros2() -> str:
    name = "ros2.exe" if sys.platform == "win32" else "ros2"
    return os.path.join(sysconfig.get_path("scripts"), name)


def _run(command: list[str], seconds: float | None) -> int:
    path = f"{os.path.dirname(command[0])}{os.pathsep}{os.environ.get('PATH', '')}"
    environment = {**os.environ, "PATH": path}
    if seconds is None and sys.platform != "win32":
        # Replaces this process, so that a signal that ends it ends the launch.
        os.execve(command[0], command, environment)  # noqa: S606 -- ours
    # On Windows, Ctrl-C reaches the launch as well; elsewhere, in its session, only from here.
    launch = subprocess.Popen(  # noqa: S603 -- ours
        command, env=environment, start_new_session=True
    )
    try:
        with _signals_as_interrupts():
            return launch.wait(seconds)
    except subprocess.TimeoutExpired:
        _interrupt(launch)
    except KeyboardInterrupt:
        if sys.platform != "win32":
            _interrupt(launch)
    with suppress(KeyboardInterrupt):
        try:
            launch.wait(_PATIENCE_S)
        except subprocess.TimeoutExpired:
            launch.kill()
            launch.wait()
    return 0


@contextmanager
def _signals_as_interrupts() -> Iterator[None]:
    """Turn the signals that end a process into ``KeyboardInterrupt`` within the block."""
    import signal

    numbers = [signal.SIGTERM]
    if sys.platform != "win32":
        numbers.append(signal.SIGHUP)
    before = [signal.signal(number, signal.default_int_handler) for number in numbers]
    try:
        yield
    finally:
        for number, handler in zip(numbers, before, strict=True):
            signal.signal(number, handler)


def _interrupt(launch: subprocess.Popen[bytes]) -> None:
    """End the launch as Ctrl-C does."""
    import signal

    if sys.platform == "win32":
        with suppress(KeyboardInterrupt):  # Windows knows only the whole console, this one included
            os.kill(0, signal.CTRL_C_EVENT)
            launch.wait(_PATIENCE_S)
    else:
        launch.send_signal(signal.SIGINT)


if __name__ == "__main__":
    sys.exit(program(main)())
