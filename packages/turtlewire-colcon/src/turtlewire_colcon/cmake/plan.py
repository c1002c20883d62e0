"""The files that a package installs, its interfaces and its tests, by its CMakeLists.txt."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from pathlib import Path

    from turtlewire_colcon.cmake.syntax import CMakeError, SourcePosition

__all__ = [
    "CompiledTarget",
    "FileRule",
    "Install",
    "Interfaces",
    "Plan",
    "PlannedTest",
    "PythonModule",
    "PythonPackage",
    "Resource",
    "Step",
]


#: Names of compiled targets in a warning.
_NAMED_TARGETS = 4


class CompiledTarget(NamedTuple):
    """A target that would compile C++: its name, and the command that adds it."""

    name: str
    place: SourcePosition


class FileRule(NamedTuple):
    """``PATTERN`` or ``REGEX`` of an ``install(DIRECTORY …)``.

    Attributes:
        expression: Regular expression that is searched in the path, which begins with ``/``.
        excludes: Whether what matches stays behind.
    """

    expression: str
    excludes: bool


class Install(NamedTuple):
    """One ``install`` command.

    Attributes:
        kind: ``DIRECTORY``, ``FILES`` or ``PROGRAMS``.
        sources: Paths. A directory that ends with ``/`` means its contents.
        destination: Where they go, relative to the prefix.
        place: Where the command stands.
        rename: Name of the installed file, or empty.
        optional: Whether to ignore a missing file.
        rules: For directories: which of their files.
        only_matching: Whether files are installed that match a rule, and no others.
    """

    kind: str
    sources: tuple[str, ...]
    destination: str
    place: SourcePosition
    rename: str = ""
    optional: bool = False
    rules: tuple[FileRule, ...] = ()
    only_matching: bool = False


class PythonPackage(NamedTuple):
    """One ``ament_python_install_package``.

    Attributes:
        name: The package that is imported.
        folder: Where its sources are.
        version: Its version.
        destination: Folder of the prefix for it; empty for site-packages.
        setup_cfg: The file with its entry points, or None.
        scripts: Folder of the prefix for its console scripts, or empty for no scripts.
        place: Where the command stands.
    """

    name: str
    folder: Path
    version: str
    destination: str
    setup_cfg: Path | None
    scripts: str
    place: SourcePosition


class PythonModule(NamedTuple):
    """One ``ament_python_install_module``: a file, and the folder below site-packages for it."""

    file: Path
    suffix: str
    place: SourcePosition


class Interfaces(NamedTuple):
    """One ``rosidl_generate_interfaces``.

    Attributes:
        package: The Python package that is generated.
        files: The definitions: their paths relative to the package (``msg/A.msg``), and on disk.
        installed: False with ``SKIP_INSTALL``.
        place: Where the command stands.
    """

    package: str
    files: tuple[tuple[str, Path], ...]
    installed: bool
    place: SourcePosition


class Resource(NamedTuple):
    """An entry of ament's index: ``resource_index/<kind>/<package>``."""

    kind: str
    package: str
    content: str


class Step(NamedTuple):
    """A program that runs before anything is installed: its words, its folder, and its command."""

    words: tuple[str, ...]
    folder: str
    place: SourcePosition


class PlannedTest(NamedTuple):
    """A test that ``colcon test`` runs.

    Attributes:
        name: Names its result file.
        kind: ``pytest``, ``launch`` or ``command``.
        words: The file to test, or the command.
        environment: Variables set for it.
        folder: Where it runs.
        timeout: Seconds.
        isolated: Whether it runs in its own ROS domain.
    """

    name: str
    kind: str
    words: tuple[str, ...]
    environment: dict[str, str]
    folder: str
    timeout: float
    isolated: bool = False


@dataclass
class Plan:
    """The files, interfaces and tests of a package.

    Attributes:
        name: Name of the project.
        version: As in package.xml.
        compiled: Targets that would compile C++; tests are not among them.
        faults: Commands that could not be evaluated, perhaps because of the C++ part.
        unknown: One line for each command that is not known.
        missing: One line for each required package that is not there.
        warnings: Messages of the file itself.
        targets: Names of targets that exist, those without a result included.
        custom_targets: Targets of ``add_custom_target``.
        steps: Programs that make files.
        install_code: Commands of ``install(CODE …)``, which run last.
    """

    name: str = ""
    version: str = "0.0.0"
    installs: list[Install] = field(default_factory=list)
    python_packages: list[PythonPackage] = field(default_factory=list)
    python_modules: list[PythonModule] = field(default_factory=list)
    interfaces: list[Interfaces] = field(default_factory=list)
    resources: list[Resource] = field(default_factory=list)
    hooks: list[Path] = field(default_factory=list)
    extras: list[Path] = field(default_factory=list)
    tests: list[PlannedTest] = field(default_factory=list)
    compiled: list[CompiledTarget] = field(default_factory=list)
    faults: list[CMakeError] = field(default_factory=list)
    unknown: list[str] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    targets: set[str] = field(default_factory=set)
    custom_targets: set[str] = field(default_factory=set)
    steps: list[Step] = field(default_factory=list)
    install_code: list[tuple[str, SourcePosition]] = field(default_factory=list)

    def verdict(self) -> tuple[list[str], list[str]]:
        """Return the errors, because of which the package is not installed, and the warnings.

        In a package with C++, packages and commands that are missing are warnings: they may be
        for the C++ part, and everything else can be installed.
        """
        twice = {part.package for part in self.interfaces if part.installed}
        errors = [
            f"{package.place}: rosidl_generate_interfaces also generates a Python package "
            f"{package.name}; rename one of them"
            for package in self.python_packages
            if package.name in twice
        ]
        troubles = self.missing + self.unknown
        if not self.compiled:
            return errors + troubles, self.warnings
        faults = [str(fault) for fault in self.faults]
        return errors, [self._left_out(), *faults, *troubles, *self.warnings]

    def _left_out(self) -> str:
        """Return the line about the C++ targets of the package."""
        names = list(dict.fromkeys(target.name for target in self.compiled))
        listed = ", ".join(names[:_NAMED_TARGETS])
        more = len(names) - _NAMED_TARGETS
        listed += f" and {more} more" if more > 0 else ""
        return (
            f"{self.compiled[0].place}: turtlewire compiles no C++, so {listed} "
            f"{'is' if len(names) == 1 else 'are'} left out; the rest of the package is installed"
        )
