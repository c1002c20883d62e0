"""Compares the public names with the last release; see docs/stability.md.

What ROS 2 defines follows ROS 2 and its distributions: `tests/surface` compares it.
"""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING

import griffe
from distributions import PACKAGES, ROOT

if TYPE_CHECKING:
    from pathlib import Path

#: The packages with a page in docs/reference; a name is public if its package exports it.
PUBLIC = {
    "turtlewire": ["", "bag", "errors", "geometry", "msg", "net", "testing", "trajectory", "urdf"],
    "turtlewire_view": [""],
}


def last_release(root: Path) -> str:
    """Return the newest tag of a release before HEAD; empty without one."""
    found = subprocess.run(
        ["git", "describe", "--tags", "--abbrev=0", "--match", "v[0-9]*"],
        cwd=root,
        capture_output=True,
        text=True,
        check=False,
    )
    return found.stdout.strip()


def may_break(before: str, now: str) -> bool:
    """Return True if semantic versioning lets a version break what another one promised."""
    old, new = ([int(number) for number in re.findall(r"\d+", each)] for each in (before, now))
    return old[0] != new[0] or (new[0] == 0 and old[:2] != new[:2])


def breakages(root: Path, package: str, public: list[str], tag: str) -> Iterator[str]:
    """Yield what has changed so that a user's program may fail, one line each.

    Args:
        root: The checkout.
        package: ``"turtlewire"``.
        public: Its public packages; the empty name is the package itself.
        tag: The release to compare with.
    """
    source = f"packages/{package.replace('_', '-')}/src"
    old = griffe.load_git(package, ref=tag, repo=root, search_paths=[source])
    new = griffe.load(package, search_paths=[root / source])
    for name in public:
        for breakage in griffe.find_breaking_changes(exported(old, name), exported(new, name)):
            if breakage.obj.is_private:
                continue
            what = f"{breakage.obj.path}: {breakage.kind.value}"
            values = (str(each) for each in (breakage.old_value, breakage.new_value) if each)
            yield f"{what} ({' → '.join(values)})"


def exported(package: griffe.Object | griffe.Alias, name: str) -> griffe.Module:
    """Return a module with what a package exports, wherever that is defined."""
    found = griffe.Module(f"{package.name}.{name}" if name else package.name)
    module = package.modules.get(name) if name else package
    if module is None:
        return found
    for export in module.exports or ():
        member = module[str(export)]
        # Not by set_member(), which would move it away from its base classes.
        found.members[str(export)] = member.final_target if member.is_alias else member
    return found


def main() -> int:
    """Print what the next release would break; return the exit status."""
    tag = last_release(ROOT)
    if not tag:
        print("public surface: nothing was released yet")
        return 0
    text = (PACKAGES / "turtlewire" / "pyproject.toml").read_text(encoding="utf-8")
    version = re.findall(r'^version = "(.+)"', text, re.MULTILINE)[0]
    found = [line for each, names in PUBLIC.items() for line in breakages(ROOT, each, names, tag)]
    if not found or may_break(tag, version):
        print(f"public surface: {len(found)} incompatible changes since {tag}")
        return 0
    print(*found, sep="\n")
    print(
        f"The version {version} may not break what {tag} promised: keep the old name as a "
        "deprecated one, or raise the version (docs/stability.md).",
        file=sys.stderr,
    )
    return 1


if __name__ == "__main__":
    sys.exit(main())
