"""The options of the scripts that need .venv, read by a Python without turtlewire.

So a wrong word ends a script before the set-up, which takes minutes. Usage: python early_options.py
SCRIPT [WORD…]; status 2 after a wrong word.
"""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path

from script_options import ScriptParser
from served_pages import PAGES

BUILD = Path(__file__).resolve().parent.parent / "build"


def demo(words: list[str]) -> argparse.Namespace:
    """Return the options of scripts/demo."""
    parser = ScriptParser(
        prog="scripts/demo",
        description="One turtle follows another: the tutorial's launch file, ready to run.",
    )
    mode = parser.add_mutually_exclusive_group()
    mode.add_argument("--seconds", type=_seconds, help="stop after this many seconds")
    mode.add_argument(
        "--check",
        action="store_true",
        help="run headless, drive turtle1 through a square, print figures; "
        "status 0 if turtle2 followed",
    )
    return parser.parse_args(words)


def docs(words: list[str]) -> argparse.Namespace:
    """Return the options of scripts/docs."""
    parser = ScriptParser(
        prog="scripts/docs",
        description="Builds the site: the pages of docs/, the API reference, and the lesson.",
    )
    _add_output(parser, "site")
    parser.add_argument(
        "--base",
        default="/",
        metavar="PATH",
        help="where the host will have it, for the page of wrong addresses (default: /)",
    )
    parser.add_argument(
        "--language", default="en", help="a language of docs/sphinx/locale (default: en)"
    )
    parser.add_argument(
        "--releases",
        action="store_true",
        help="also build each release (the tags v*), below its number",
    )
    parser.add_argument(
        "--gettext",
        action="store_true",
        help="write the texts for translators into build/gettext instead",
    )
    return parser.parse_args(words)


def lesson(words: list[str]) -> argparse.Namespace:
    """Return the options of scripts/lesson."""
    parser = ScriptParser(
        prog="scripts/lesson",
        description="Builds the lesson, a static page that runs the tutorial in a browser tab.",
    )
    _add_output(parser, "lesson")
    return parser.parse_args(words)


def page_audit(words: list[str]) -> argparse.Namespace:
    """Return the options of scripts/page-audit."""
    parser = ScriptParser(
        prog="scripts/page-audit",
        description="Audits the pages that turtlewire serves, with Lighthouse and axe, and prints "
        "a table: the scores, the layout shift, the bytes, and below it what was found. Needs "
        "Debian's chromium, what scripts/npm-tools fetches, and for the lesson and the site what "
        "scripts/lesson and scripts/docs build.",
    )
    parser.add_argument("pages", nargs="*", metavar="PAGE", help=", ".join(PAGES))
    options = parser.parse_args(words)
    if unknown := [name for name in options.pages if name not in PAGES]:
        parser.error(f"there is no page {', '.join(unknown)}; choose from {', '.join(PAGES)}")
    return options


def soak(words: list[str]) -> argparse.Namespace:
    """Return the options of scripts/soak."""
    parser = ScriptParser(
        prog="scripts/soak",
        description="Runs nodes, listeners, services and the page while processes come and go, "
        "measures them, and fails when one of them grows.",
    )
    parser.add_argument("--minutes", type=float, default=15.0, help="default: %(default)s")
    options = parser.parse_args(words)
    if not sys.platform.startswith("linux"):
        parser.error("needs /proc, which only Linux has")
    if not 0.5 <= options.minutes <= 10_000:
        parser.error(f"--minutes is between 0.5 and 10000, got {options.minutes:g}")
    return options


def _add_output(parser: argparse.ArgumentParser, name: str) -> None:
    parser.add_argument(
        "--output",
        type=Path,
        default=BUILD / name,
        metavar="FOLDER",
        help=f"where to build it; an older one there is replaced (default: build/{name})",
    )
    parser.add_argument("--serve", action="store_true", help="show it on this machine")
    parser.add_argument("--port", type=_port, default=8000, help="of --serve (default: 8000)")


def _port(text: str) -> int:
    if not (text.isdecimal() and len(text) < 6 and int(text) < 65536):
        raise argparse.ArgumentTypeError(f"{text} is not a port; give a number from 0 to 65535")
    return int(text)


def _seconds(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError(
            f"{text} is not a time to wait for; give a positive number"
        )
    return value


if __name__ == "__main__":
    {"demo": demo, "docs": docs, "lesson": lesson, "page-audit": page_audit, "soak": soak}[
        sys.argv[1]
    ](sys.argv[2:])
