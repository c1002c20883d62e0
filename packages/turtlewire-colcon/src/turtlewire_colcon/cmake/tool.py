"""``python -m turtlewire_colcon.cmake.tool -E …``: ``cmake -E`` without CMake."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from shutil import copy2, copytree, rmtree

__all__ = ["main", "tool_command"]


def tool_command(words: Sequence[str]) -> list[str]:
    """A command with this module in the place of ``cmake`` (the variable ``CMAKE_COMMAND``)."""
    if words[:1] == ["cmake"]:
        return [sys.executable, "-m", "turtlewire_colcon.cmake.tool", *words[1:]]
    return list(words)


def main(argv: list[str] | None = None) -> int:
    """Run the command line; returns the exit status."""
    words = sys.argv[1:] if argv is None else argv
    if len(words) < 2 or words[0] != "-E" or words[1] not in _ACTIONS:
        _say(f"cmake {' '.join(words)}: only cmake -E {', '.join(sorted(_ACTIONS))} are known here")
        return 1
    try:
        return _ACTIONS[words[1]](words[2:]) or 0
    except (OSError, IndexError) as error:
        _say(f"cmake {' '.join(words)}: {error}")
        return 1


def _say(text: str) -> None:
    print(text, file=sys.stderr)  # noqa: T201 -- a command line prints


def _env(words: list[str]) -> int:
    environment = dict(os.environ)
    while words and ("=" in words[0] or words[0].startswith("--")):
        word = words.pop(0)
        name, equals, value = word.partition("=")
        if equals and not word.startswith("--"):
            # CMake's own quotes of a value (A="b") are the shell's when make runs the command.
            environment[name] = value.strip('"')
        elif word.startswith("--unset="):
            environment.pop(value, None)
    command = tool_command(words)
    # The command is the package's own, as with CMake.
    return subprocess.run(command, env=environment, check=False).returncode  # noqa: S603


def _copy(words: list[str]) -> None:
    *sources, target = words
    for source in sources:
        copy2(source, target)


def _copy_directory(words: list[str]) -> None:
    *sources, target = words
    for source in sources:
        copytree(source, target, dirs_exist_ok=True)


def _create_symlink(words: list[str]) -> None:
    source, target = words
    Path(target).unlink(missing_ok=True)
    Path(target).symlink_to(source)


def _make_directory(words: list[str]) -> None:
    for word in words:
        Path(word).mkdir(parents=True, exist_ok=True)


def _remove(words: list[str]) -> None:
    for word in words:
        if Path(word).is_dir() and not Path(word).is_symlink():
            rmtree(word)
        elif not word.startswith("-"):
            Path(word).unlink(missing_ok=True)


def _touch(words: list[str]) -> None:
    for word in words:
        Path(word).touch()


def _echo(words: list[str]) -> None:
    print(*words)  # noqa: T201 -- that is its purpose


_ACTIONS: dict[str, Callable[[list[str]], int | None]] = {
    "env": _env,
    "copy": _copy,
    "copy_if_different": _copy,
    "copy_directory": _copy_directory,
    "create_symlink": _create_symlink,
    "make_directory": _make_directory,
    "rm": _remove,
    "remove": _remove,
    "remove_directory": _remove,
    "touch": _touch,
    "echo": _echo,
}


if __name__ == "__main__":
    sys.exit(main())
