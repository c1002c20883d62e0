"""The implementation of scripts/release: sdists, wheels, checks and notes, in build/release.

`release_wheels` defines the wheels, `release_checks` checks them. Wheels of
other platforms come from .github/workflows/wheels.yml.
"""

from __future__ import annotations

import re
import shutil
import sys
import tarfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))  # also where it is loaded by its path

from distributions import LEARNING, distributions
from release_checks import check_sdist, check_wheel, make_tools, tagged, tell_sizes, try_wheels
from release_steps import ROOT, WORK, ReleaseError, output, run, say
from release_wheels import (
    MACHINES,
    VERSIONS,
    Target,
    interpreters,
    make_builder,
    make_sdist,
    make_wheel,
    possible_machines,
    targets,
)
from script_options import ScriptParser

PROJECTS = {folder.name: folder for folder in distributions() if folder != LEARNING}


def main() -> int:
    """Build, check and describe a release; the exit status."""
    parser = ScriptParser(
        prog="scripts/release",
        description="Builds sdists and wheels into build/release, checks them, and writes the "
        "notes. Uploads nothing.",
    )
    parser.add_argument(
        "--python",
        action="append",
        choices=VERSIONS,
        metavar="VERSION",
        help=f"only for this Python ({', '.join(VERSIONS)}); may be given more than once; from "
        "3.12 on, one wheel is for all",
    )
    parser.add_argument(
        "--machine",
        choices=MACHINES,
        help="only for this processor; on x86-64, aarch64 needs g++-aarch64-linux-gnu",
    )
    parser.add_argument(
        "--dirty", action="store_true", help="although there are changes that are not committed"
    )
    arguments = parser.parse_args()
    try:
        release(
            tuple(arguments.python or VERSIONS),
            (arguments.machine,) if arguments.machine else MACHINES,
            dirty=arguments.dirty,
        )
    except ReleaseError as error:
        print(f"[release] {error}", file=sys.stderr)
        return 1
    return 0


def release(versions: tuple[str, ...], machines: tuple[str, ...], *, dirty: bool) -> None:
    """Run all steps, into an empty build/release."""
    number = version_of_all()
    if not dirty and output("git", "status", "--porcelain", "--untracked-files=no"):
        raise ReleaseError("there are changes that are not committed (--dirty builds them as well)")
    wheels = targets(pythons := interpreters(versions), possible_machines(machines))
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    (WORK / "NOTES.md").write_text(notes(number), encoding="utf-8")
    any_python = next(iter(pythons.values()))
    tools = make_tools(any_python)
    builders = {python: make_builder(python) for python in {each.python for each in wheels}}
    sources = make_sources(next(iter(builders.values())))
    for target in wheels:
        make_core(tools, builders[target.python], sources["turtlewire"], target)
    builder = next(iter(builders.values()))
    for name in sources.keys() - {"turtlewire"}:  # they have no compiled module
        wheel = make_wheel(builder, sources[name], None, WORK / "raw" / name)
        check_wheel(Path(shutil.copy(wheel, WORK)), None)
    made = sorted([*WORK.glob("*.whl"), *WORK.glob("*.tar.gz")])
    run(tools / "twine", "check", "--strict", *made, what="twine's check")
    for version, python in pythons.items():
        if any(not target.foreign for target in wheels):
            try_wheels(version, python)
    tell_sizes(made)
    say(f"ready: {number}; read {(WORK / 'NOTES.md').relative_to(ROOT)}")


def make_sources(python: Path) -> dict[str, Path]:
    """Return the sdists of all projects, checked and unpacked; the folders."""
    folders = {}
    for name, folder in PROJECTS.items():
        sdist = make_sdist(python, name, folder)
        check_sdist(sdist)
        with tarfile.open(sdist) as archive:
            archive.extractall(WORK / "sources")  # our own, made above
        folders[name] = WORK / "sources" / sdist.name.removesuffix(".tar.gz")
    return folders


def make_core(tools: Path, python: Path, source: Path, target: Target) -> None:
    """The core's wheel for one target, tagged and checked, in build/release."""
    raw = WORK / "raw" / f"{target.machine}-{target.tag}"
    wheel = tagged(tools, make_wheel(python, source, target, raw), target)
    check_wheel(wheel, "turtlewire")


def version_of_all() -> str:
    """Return the version that every project has."""
    found = {
        match[1]
        for folder in PROJECTS.values()
        for match in re.finditer(
            r'^(?:version = |    "turtlewire==)"?([^"]+)"',
            (folder / "pyproject.toml").read_text(encoding="utf-8"),
            re.MULTILINE,
        )
    }
    if len(found) != 1:
        raise ReleaseError(f"the projects have different versions: {', '.join(sorted(found))}")
    return found.pop()


def notes(number: str) -> str:
    """Return the section of the CHANGELOG about a version, or what is not released yet."""
    sections = re.split(
        r"^## (.*)\n", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), flags=re.MULTILINE
    )
    by_title = dict(zip(sections[1::2], sections[2::2], strict=True))
    text = by_title.get(number, by_title.get("Unreleased"))
    if text is None:
        raise ReleaseError(f"CHANGELOG.md has no section {number!r} and none 'Unreleased'")
    return f"# turtlewire {number}\n{text.rstrip()}\n"


if __name__ == "__main__":
    sys.exit(main())
