"""What a package installs, generates and tests, as its CMakeLists.txt says."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from pathlib import Path

    from turtlewire_colcon.cmake.syntax import Place

__all__ = [
    "FileRule",
    "Install",
    "Interfaces",
    "Plan",
    "PythonModule",
    "PythonPackage",
    "Resource",
    "Step",
    "TestRun",
]


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
        sources: Paths. A directory that ends with ``/`` stands for its contents.
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
    place: Place
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
    place: Place


class PythonModule(NamedTuple):
    """One ``ament_python_install_module``: a file, and the folder below site-packages for it."""

    file: Path
    suffix: str
    place: Place


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
    place: Place


class Resource(NamedTuple):
    """An entry of ament's index: ``resource_index/<kind>/<package>``."""

    kind: str
    package: str
    content: str


class Step(NamedTuple):
    """A program that runs before anything is installed: its words, its folder, and its command."""

    words: tuple[str, ...]
    folder: str
    place: Place


class TestRun(NamedTuple):
    """A test that ``colcon test`` runs.

    Attributes:
        name: Names its result file.
        kind: ``pytest``, ``launch`` or ``command``.
        words: The file to test, or the command.
        environment: Variables set for it.
        folder: Where it runs.
        timeout: Seconds.
        isolated: Whether it runs in a ROS domain of its own.
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
    """What a package installs, generates and tests.

    Attributes:
        name: Name of the project.
        version: As in package.xml.
        refused: One line for each target that would compile C++.
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
    tests: list[TestRun] = field(default_factory=list)
    refused: list[str] = field(default_factory=list)
    unknown: list[str] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    targets: set[str] = field(default_factory=set)
    custom_targets: set[str] = field(default_factory=set)
    steps: list[Step] = field(default_factory=list)
    install_code: list[tuple[str, Place]] = field(default_factory=list)

    def has_python(self) -> bool:
        """Return True if the package installs Python code, not only data."""
        return bool(
            self.python_packages
            or self.python_modules
            or self.interfaces
            or any(install.kind == "PROGRAMS" for install in self.installs)
        )

    def verdict(self) -> tuple[list[str], list[str]]:
        """Errors, because of which the package is not installed, and warnings.

        The Python part of a package with C++ is installed, and what it refuses or misses are
        warnings: packages and commands that are not known may be for the C++ part.
        """
        troubles = self.missing + self.unknown
        twice = {part.package for part in self.interfaces if part.installed}
        troubles += [
            f"{package.place}: rosidl_generate_interfaces also generates a Python package "
            f"{package.name}; rename one of them"
            for package in self.python_packages
            if package.name in twice
        ]
        if not self.refused:
            return troubles, self.warnings
        if not self.has_python():
            return self.refused, self.warnings
        rest = "its Python and data are installed without it"
        return [], [*(f"{line}; {rest}" for line in self.refused), *troubles, *self.warnings]
