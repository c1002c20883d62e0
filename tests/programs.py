"""Short programs in a process of their own."""

from __future__ import annotations

import subprocess
import sys
from typing import Any


def run_python(
    code: str, *arguments: str, check: bool = True, **options: Any
) -> subprocess.CompletedProcess[str]:
    """Run a program on this interpreter; returns its status and what it printed.

    Args:
        code: The program.
        arguments: Its arguments.
        check: Whether a status other than 0 raises.
        options: Options of `subprocess.run`, such as `env` and `cwd`.
    """
    command = [sys.executable, "-c", code, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=check, **options)
