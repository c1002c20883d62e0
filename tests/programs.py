"""Short programs in a process of their own: of another distribution of ROS 2, or asked for TAB."""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
from typing import Any

#: `ros2` on this interpreter, to be followed by its words; and the same for a shell.
ROS2 = (
    sys.executable,
    "-c",
    "import sys; from ros2cli.main import main; sys.exit(main(sys.argv[1:]))",
)
ROS2_IN_SHELL = shlex.join(ROS2)


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


#: A function for such programs: what a call returns and warns of, or the error that it raises.
OUTCOME = """
import warnings

def outcome(call):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            value = call()
        except Exception as error:
            return f"{type(error).__name__}: {error}"
    return f"{value} {[f'{each.category.__name__}: {each.message}' for each in caught]}"
"""


def lines_in(distro: object, program: str) -> list[str]:
    """Run a program; return the lines that it prints."""
    done = run_python(
        program,
        check=False,
        timeout=120,
        env={**os.environ, "ROS_DISTRO": str(distro), "RMW_IMPLEMENTATION": "local"},
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def offered(line):
    """The completions of a command line, asked for as argcomplete's shell function asks."""
    reading, writing = os.pipe()
    program = "import sys; from ros2cli.main import main; sys.argv[0] = 'ros2'; sys.exit(main())"
    environment = os.environ | {
        "_ARGCOMPLETE": "1",
        "_ARGCOMPLETE_IFS": "\n",
        "_ARGCOMPLETE_SUPPRESS_SPACE": "1",
        "COMP_LINE": line,
        "COMP_POINT": str(len(line)),
        "COMP_TYPE": "9",
    }
    script = f'exec "{sys.executable}" -c "{program}" 8>&{writing} 9>/dev/null'
    subprocess.run(
        ["bash", "-c", script],
        env=environment,
        pass_fds=[writing],
        check=False,
        capture_output=True,
        timeout=300,
    )
    os.close(writing)
    with os.fdopen(reading) as answers:
        return {word.strip() for word in answers.read().split("\n")} - {""}
