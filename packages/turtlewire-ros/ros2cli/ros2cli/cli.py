"""The command line, as programs call it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ros2cli.command import CommandExtension


def main(
    *,
    script_name: str = "ros2",
    argv: list[str] | None = None,
    description: str | None = None,
    extension: CommandExtension | None = None,
) -> Any:
    """Run ``ros2``, or one command as a separate program.

    Args:
        script_name: Name of the program in the help.
        argv: The words after it; this process's by default.
        description: What the help says of it.
        extension: The only command of the program; None for all commands of ``ros2``.

    Returns:
        The exit status, or the text of an error.
    """
    if extension is None:
        from ros2cli.main import main as run

        return run(argv)
    import argparse
    import sys

    from ros2cli.plugin_system import call_add_arguments

    words = sys.argv[1:] if argv is None else argv
    parser = argparse.ArgumentParser(prog=script_name, description=description)
    call_add_arguments(extension, parser, script_name, words)
    try:
        return extension.main(parser=parser, args=parser.parse_args(words))
    except KeyboardInterrupt:
        return 2  # the number of SIGINT
    except RuntimeError as error:
        return str(error)
