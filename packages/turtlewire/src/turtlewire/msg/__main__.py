"""``python -m turtlewire.msg DIR``.

Makes a Python package of a folder with interface definitions.
"""

from __future__ import annotations

import sys
from pathlib import Path

from turtlewire.errors import InterfaceError
from turtlewire.msg.generate import generate_package
from turtlewire.program import program
from turtlewire.terminal.parser import SuggestingParser


def main(argv: list[str] | None = None) -> int:
    """Run the command line; returns the exit status."""
    parser = SuggestingParser(
        prog="python -m turtlewire.msg",
        description="Turn the msg, srv and action folders of an interface package into a Python "
        "package: no compiler needed.",
    )
    parser.add_argument(
        "directory", type=Path, help="the interface package, with msg, srv or action folders in it"
    )
    parser.add_argument(
        "--output",
        type=Path,
        default=Path(),
        help="where to put the Python package (default: the current folder)",
    )
    parser.add_argument(
        "--package",
        default="",
        help="name of the package (default: as in package.xml, else the name of the folder)",
    )
    options = parser.parse_args(argv)
    try:
        folder = generate_package(options.directory, options.output, options.package)
    except InterfaceError as error:
        # A command line prints.
        print(error, error.hint, sep="\n" if error.hint else "", file=sys.stderr)  # noqa: T201
        return 1
    except OSError as error:
        print(error, file=sys.stderr)  # noqa: T201 - as above
        return 1
    print(  # noqa: T201
        f"{folder} is ready: put {folder.parent.resolve()} on PYTHONPATH, then `from "
        f"{folder.name}.msg import ...`"
    )
    return 0


if __name__ == "__main__":
    sys.exit(program(main)())
