"""The implementation of scripts/release: sdists, wheels, checks and notes, in build/release.

`release_wheels` defines the wheels, `release_checks` checks them. Wheels of
other platforms come from .github/workflows/wheels.yml.
"""

from __future__ import annotations

import os
import re
import shutil
import sys
import tarfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))  # also where it is loaded by its path

from distributions import LEARNING, distributions
from release_checks import (
    check_again,
    check_sdist,
    check_wheel,
    make_tools,
    tagged,
    tell_sizes,
    try_wheels,
)
from release_wheels import (
    MACHINES,
    ROOT,
    VERSIONS,
    WORK,
    ReleaseError,
    Target,
    interpreters,
    make_builder,
    make_sdist,
    make_wheel,
    output,
    possible_machines,
    run,
    say,
    targets,
)
from script_options import ScriptParser

#: The version of a project, or the one that it requires of another.
VERSION = re.compile(
    r'(?P<before>^version = "|"turtlewire[a-z-]*==)(?P<version>[^"]+)(?P<after>")', re.MULTILINE
)
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
    parser.add_argument(
        "--set",
        metavar="VERSION",
        help="write a version into each pyproject.toml, and build nothing",
    )
    arguments = parser.parse_args()
    try:
        if arguments.set:
            set_version(arguments.set)
            return 0
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
    # The tools write this time into their archives, so the same commit gives the same bytes.
    os.environ.setdefault("SOURCE_DATE_EPOCH", output("git", "log", "-1", "--format=%ct"))
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    (WORK / "NOTES.md").write_text(notes(number), encoding="utf-8")
    any_python = next(iter(pythons.values()))
    tools = make_tools(any_python)
    builders = {python: make_builder(python) for python in {each.python for each in wheels}}
    sources = make_sources(next(iter(builders.values())))
    for target in wheels:
        is_first = target is wheels[0]
        python = builders[target.python]
        make_core(tools, python, sources["turtlewire"], target, is_compared=is_first)
    builder = next(iter(builders.values()))
    for name in sources.keys() - {"turtlewire"}:  # they have no compiled module
        wheel = make_wheel(builder, sources[name], None, WORK / "raw" / name)
        check_wheel(Path(shutil.copy(wheel, WORK)), None)
        check_again(wheel, make_wheel(builder, sources[name], None, WORK / "again" / name))
    made = sorted([*WORK.glob("*.whl"), *WORK.glob("*.tar.gz")])
    run(tools / "twine", "check", "--strict", *made, what="twine's check")
    # Intended: equal interfaces (W002), launch files in share (W004), several packages (W009).
    contents = [tools / "check-wheel-contents", "--ignore", "W002,W004,W009"]
    run(*contents, *WORK.glob("*.whl"), what="check-wheel-contents")
    for version, interpreter in pythons.items():
        if any(not target.foreign for target in wheels):
            try_wheels(version, interpreter)
    tell_sizes(made)
    say(f"ready: {number}; read {(WORK / 'NOTES.md').relative_to(ROOT)}")


def make_sources(python: Path) -> dict[str, Path]:
    """Return the sdists of all projects, checked and unpacked; the folders."""
    folders = {}
    for name, folder in PROJECTS.items():
        sdist = make_sdist(python, name, folder, WORK)
        check_sdist(sdist)
        check_again(sdist, make_sdist(python, name, folder, WORK / "again"))
        with tarfile.open(sdist) as archive:
            archive.extractall(WORK / "sources")  # our own, made above
        folders[name] = WORK / "sources" / sdist.name.removesuffix(".tar.gz")
    return folders


def make_core(
    tools: Path, python: Path, source: Path, target: Target, *, is_compared: bool
) -> None:
    """Build and check the core's wheel for one target, in build/release.

    Args:
        tools: The folder of the commands that check.
        python: The Python that builds.
        source: The unpacked sdist.
        target: What the wheel is for.
        is_compared: Build it a second time, in another folder, and compare the bytes.
    """
    raw = WORK / "raw" / f"{target.machine}-{target.tag}"
    first = make_wheel(python, source, target, raw)
    if is_compared:
        again = WORK / "again" / target.tag
        shutil.copytree(source, again / "source", ignore=shutil.ignore_patterns("build"))
        check_again(first, make_wheel(python, again / "source", target, again))
    check_wheel(tagged(tools, first, target), "turtlewire")


def set_version(number: str) -> None:
    """Write a version into each project, also where one requires another.

    Raises:
        ReleaseError: The version does not have three numbers.
    """
    if not re.fullmatch(r"\d+\.\d+\.\d+(rc\d+)?", number):
        raise ReleaseError(f"{number!r} is not a version such as 1.2.0 or 1.2.0rc1")
    before = version_of_all()
    for folder in PROJECTS.values():
        file = folder / "pyproject.toml"
        text = file.read_text(encoding="utf-8")
        file.write_text(VERSION.sub(rf"\g<before>{number}\g<after>", text), encoding="utf-8")
    say(f"{before} is now {version_of_all()}")


def version_of_all() -> str:
    """Return the version that every project has."""
    found = {
        match["version"]
        for folder in PROJECTS.values()
        for match in VERSION.finditer((folder / "pyproject.toml").read_text(encoding="utf-8"))
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
