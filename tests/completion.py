"""Words that a shell is offered for TAB, asked for as argcomplete's shell function asks."""

from __future__ import annotations

import os
import subprocess
import sys


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
