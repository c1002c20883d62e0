"""The output of the set-up, and its calls of other programs."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import IO, NoReturn

from distributions import ROOT

VENV = ROOT / ".venv"
PYTHON = VENV / "bin" / "python"
#: Output of the last program that `checked` ran.
LOG = VENV / "setup.log"
#: Where apt keeps the lists of packages that it can install.
APT_LISTS = Path("/var/lib/apt/lists")
#: How many lines of a failed program's output are shown.
SHOWN_LINES = 40
#: What pip and uv print when they cannot reach the package index.
NO_NETWORK = re.compile(
    r"NewConnectionError|NameResolutionError|ConnectTimeoutError|Max retries exceeded|ProxyError"
    r"|dns error|client error \(Connect\)"
)


class SetupError(Exception):
    """An error whose text names in one sentence what is missing."""


def say(text: str) -> None:
    """Print a line for the user."""
    print(f"[setup] {text}", file=sys.stderr, flush=True)


@contextmanager
def stage(text: str) -> Iterator[None]:
    """Say what begins, and how long it took."""
    say(f"{text} ...")
    started = time.monotonic()
    yield
    say(f"... done in {time.monotonic() - started:.0f} s")


def type_this(packages: str) -> str:
    """Return the sentence that asks for packages of Debian or its relatives."""
    line = f"apt install {packages}"
    if not any(APT_LISTS.glob("*_Packages*")):  # as in a fresh container
        line = f"apt update && {line}"
    who = ""
    if os.geteuid() != 0:
        if shutil.which("sudo"):
            line = line.replace("apt ", "sudo apt ")
        else:
            who = " as root"
    return f"type this line{who}, then the same again:\n\n    {line}\n"


def clean_environment() -> dict[str, str]:
    """Return the environment without what a sourced ROS 2 would mix in."""
    return {
        name: value
        for name, value in os.environ.items()
        if name not in {"PYTHONPATH", "PYTHONHOME", "AMENT_PREFIX_PATH"}
    }


def run_python(*arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the venv's Python quietly."""
    return subprocess.run(
        [str(PYTHON), *arguments],
        capture_output=True,
        text=True,
        check=False,
        env=clean_environment(),
    )


def pip(*arguments: str, settings: Mapping[str, str] | None = None) -> None:
    """Run the venv's pip, with further environment variables."""
    command = [str(PYTHON), "-m", "pip", "--disable-pip-version-check", "--no-input"]
    checked([*command, *arguments], settings)


def checked(command: list[str], settings: Mapping[str, str] | None = None) -> None:
    """Run a command whose failure ends the set-up, and show what it printed if it fails."""
    environment = {
        **clean_environment(),
        # setuptools warns at length about every editable installation
        "PYTHONWARNINGS": "ignore::UserWarning",
        "PYTHONUNBUFFERED": "1",  # each line is progress
        **(settings or {}),
    }
    with LOG.open("w+", encoding="utf-8", errors="replace") as output:
        # In a separate session: Ctrl-C reaches only this program, which stops the whole group.
        with subprocess.Popen(
            command,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        ) as process:
            try:
                follow(process)
            except BaseException:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
                raise
            finally:
                show_progress("")
        if process.returncode:
            output.seek(0)
            fail(command, output.read())


def follow(process: subprocess.Popen[bytes]) -> None:
    """Show the seconds and the last line of output until a process ends."""
    started = time.monotonic()
    with LOG.open("rb") as output:
        while not ended_within(process, 1.0):
            show_progress(f"[setup] {time.monotonic() - started:.0f} s {last_line(output)}")


def last_line(output: IO[bytes]) -> str:
    """Return the last line of a file, without control characters."""
    end = output.seek(0, os.SEEK_END)
    output.seek(max(0, end - 2000))
    lines = output.read().decode(errors="replace").split("\n")
    text = next((line.strip() for line in reversed(lines) if line.strip()), "")
    return "".join(filter(str.isprintable, text))


def ended_within(process: subprocess.Popen[bytes], seconds: float) -> bool:
    """Wait for the end of a process; False if it still runs after that time."""
    try:
        process.wait(seconds)
    except subprocess.TimeoutExpired:
        return False
    return True


def show_progress(text: str) -> None:
    """Replace the progress line, if the output is a terminal."""
    if sys.stderr.isatty():
        width = shutil.get_terminal_size().columns - 1
        print(f"\r\033[K{text[:width]}", end="", file=sys.stderr, flush=True)


def fail(command: list[str], output: str) -> NoReturn:
    """Raise the error that says why a command failed."""
    if NO_NETWORK.search(output):
        raise SetupError(
            "no network: the package index cannot be reached; connect, then type the same again"
        )
    sys.stderr.writelines(output.splitlines(keepends=True)[-SHOWN_LINES:])
    raise SetupError(f"this failed, see above and {LOG}: {' '.join(command)}")
