"""The path of an executable of a package."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ament_index_python.packages import get_package_prefix
from launch.frontend.expose import expose_substitution
from launch.substitution import described
from launch.substitutions import PathSubstitution, SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from turtlewire_ros.executables import executable_paths, libexec_directory
from turtlewire_ros.workspace_hints import executable_hint

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


@expose_substitution("exec-in-pkg")
class ExecutableInPackage(PathSubstitution):
    """The path of an executable of a package.

    Args:
        executable: Its name.
        package: The package.
    """

    def __init__(self, executable: SomeSubstitutionsType, package: SomeSubstitutionsType) -> None:
        super().__init__(self)
        self._executable = normalize_to_list_of_substitutions(executable)
        self._package = normalize_to_list_of_substitutions(package)

    @classmethod
    def parse(
        cls, data: Sequence[SomeSubstitutionsType]
    ) -> tuple[type[ExecutableInPackage], dict[str, Any]]:
        """Read ``$(exec-in-pkg executable package)``."""
        if len(data) != 2:
            raise AttributeError("exec-in-pkg substitution expects 2 arguments")
        return cls, {"executable": data[0], "package": data[1]}

    @property
    def executable(self) -> list[Substitution]:
        """The name of the executable."""
        return self._executable

    @property
    def package(self) -> list[Substitution]:
        """The package."""
        return self._package

    def find(self, package_name: str) -> str:
        """Return the prefix that a package is installed in.

        Raises:
            PackageNotFoundError: The package is not installed.
        """
        return get_package_prefix(package_name)

    def describe(self) -> str:
        """Name both."""
        package, executable = described(self._package), described(self._executable)
        return f"ExecInPkg(pkg={package}, exec={executable})"

    def perform(self, context: LaunchContext) -> str:
        """Return the path.

        Raises:
            PackageNotFoundError: The package is not installed.
            SubstitutionFailure: The package has no such executable, or several.
        """
        executable = perform_substitutions(context, self._executable)
        package = perform_substitutions(context, self._package)
        prefix = get_package_prefix(package)
        names = (executable, f"{executable}.exe")
        paths = executable_paths(package) or []
        found = [path for path in paths if os.path.basename(path) in names]
        if not found:
            raise SubstitutionFailure(
                f"executable '{executable}' not found on the libexec directory "
                f"'{libexec_directory(prefix, package)}' ",
                hint=executable_hint(package, executable),
            )
        if len(found) > 1:
            raise SubstitutionFailure(
                f"multiple executables named '{executable}' found in the package '{package}': "
                f"{found}"
            )
        return found[0]
