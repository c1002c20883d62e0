"""Adds the releases to the site: builds each tag with its own ``scripts/docs``."""

from __future__ import annotations

import json
import re
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path

from lesson import BuildError

_TAG = re.compile(r"v\d+\.\d+\.\d+")
#: The list that a page reads for its menu of versions, at the root of the site.
LIST = "versions.json"


def releases(repository: Path) -> list[str]:
    """Return the numbers of the released versions, newest first."""
    tags = filter(_TAG.fullmatch, _git(repository, "tag").split())
    ranked = sorted((tuple(map(int, tag[1:].split("."))) for tag in tags), reverse=True)
    return [".".join(map(str, number)) for number in ranked]


def is_of_release(base: str, version: str) -> bool:
    """Return True if the host will have a site in the folder of its version."""
    return base.rstrip("/").endswith(f"/{version}")


def add_releases(repository: Path, site: Path, base: str) -> list[str]:
    """Build the releases into folders of a built site, and write the list of versions.

    Args:
        repository: A clone with the tags.
        site: The site of the present state, which stays at the root.
        base: Where the host will have the site.

    Returns:
        The releases, newest first.

    Raises:
        BuildError: The site of a release cannot be built.
    """
    site = site.resolve()  # the script of a release works in its own folder
    found = releases(repository)
    for version in found:
        with tempfile.TemporaryDirectory() as folder:
            tree = Path(folder) / "turtlewire"
            _git(repository, "worktree", "add", "--detach", str(tree), f"v{version}")
            try:
                _build(tree, site / version, f"{base.rstrip('/')}/{version}/")
            finally:
                _git(repository, "worktree", "remove", "--force", str(tree))
    (site / LIST).write_text(json.dumps(found), encoding="ascii")
    return found


def _build(tree: Path, output: Path, base: str) -> None:
    print(f"[docs] building {output.name}", flush=True)
    command = ["scripts/docs", "--output", str(output), "--base", base]
    done = subprocess.run(command, cwd=tree, check=False)
    if done.returncode:
        raise BuildError(f"the site of {output.name} was not built, see above")


def _git(repository: Path, *words: str) -> str:
    command: Sequence[str] = ("git", "-C", str(repository), *words)
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise BuildError(f"{' '.join(words)}: {done.stderr.strip()}")
    return done.stdout
