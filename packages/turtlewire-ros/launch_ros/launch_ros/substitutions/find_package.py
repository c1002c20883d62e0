"""Folders of packages."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ament_index_python.packages import get_package_prefix, get_package_share_directory
from launch.frontend.expose import expose_substitution
from launch.substitution import described
from launch.substitutions.path_join_substitution import PathSubstitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


class FindPackage(PathSubstitution):
    """A folder of a package; ``/`` extends it: ``FindPackageShare("turtlesim") / "launch"``.

    Args:
        package: The package.
    """

    def __init__(self, package: SomeSubstitutionsType) -> None:
        super().__init__(self)
        self._package = normalize_to_list_of_substitutions(package)

    @classmethod
    def parse(
        cls, data: Sequence[SomeSubstitutionsType]
    ) -> tuple[type[FindPackage], dict[str, Any]]:
        """Read the name of the package."""
        if len(data) != 1:
            raise AttributeError("find package substitution expects 1 argument")
        return cls, {"package": data[0]}

    @property
    def package(self) -> list[Substitution]:
        """The package."""
        return self._package

    def find(self, package_name: str) -> str:
        """Return the folder."""
        raise NotImplementedError(f"{type(self).__name__} does not define find()")

    def describe(self) -> str:
        """Name the package."""
        return f"{type(self).__name__}(pkg={described(self._package)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the folder.

        Raises:
            PackageNotFoundError: The package is not installed.
        """
        return self.find(perform_substitutions(context, self._package))


@expose_substitution("find-pkg-prefix")
class FindPackagePrefix(FindPackage):
    """The prefix that a package is installed in.

    Args:
        package: The package.
    """

    def find(self, package_name: str) -> str:
        """Return the prefix."""
        return get_package_prefix(package_name)


@expose_substitution("find-pkg-share")
class FindPackageShare(FindPackage):
    """The folder with a package's data.

    Args:
        package: The package.
    """

    def find(self, package_name: str) -> str:
        """Return the folder."""
        return get_package_share_directory(package_name)
