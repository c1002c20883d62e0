"""The common parts of scripts/release: folders, timed steps, errors."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "build" / "release"


class ReleaseError(Exception):
    """The release cannot be built; the text is one sentence."""


def run(
    *command: object,
    what: str,
    environment: dict[str, str] | None = None,
    folder: Path = ROOT,
) -> str:
    """Run a step, and say how long it took; returns what it printed.

    Raises:
        ReleaseError: The command failed; its output was printed.
    """
    say(f"{what} …")
    started = time.monotonic()
    done = subprocess.run(
        list(map(str, command)),
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    if done.returncode:
        sys.stderr.write(done.stdout)
        raise ReleaseError(f"{what} failed, see above")
    say(f"{what}: {time.monotonic() - started:.0f} s")
    return done.stdout


def install_locked(python: Path, lock: str, *, what: str) -> None:
    """Install the releases of a file of ``tools/locks``, checked by their hashes.

    Raises:
        ReleaseError: pip failed; its output was printed.
    """
    file = ROOT / "tools" / "locks" / f"{lock}.txt"
    run(python, "-m", "pip", "install", "-q", "--require-hashes", "-r", file, what=what)


def output(*command: str) -> str:
    """Return a command's output."""
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode:
        raise ReleaseError(f"{' '.join(command)}: {done.stderr.strip()}")
    return done.stdout.strip()


def say(text: str) -> None:
    """Print a line for the user."""
    print(f"[{Path(sys.argv[0]).stem}] {text}", file=sys.stderr, flush=True)
