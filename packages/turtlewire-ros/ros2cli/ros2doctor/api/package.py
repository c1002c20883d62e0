"""Versions of the installed packages, compared with the releases of a distribution.

``ros2 doctor`` leaves this check out: it reads the index of ROS 2's releases from the network, and
turtlewire's packages have versions of their own. Programs may call it for the packages of robots.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any
from urllib.parse import urljoin

from ros2doctor.api.format import doctor_error, doctor_warn
from ros2doctor.api.reporting import DoctorCheck, DoctorReport, Report, Result

#: The index of ROS 2's releases, unless ``ROSDISTRO_INDEX_URL`` names another one.
_INDEX = "https://raw.githubusercontent.com/ros/rosdistro/master/index-v4.yaml"
_TIMEOUT_S = 30.0


def get_distro_package_versions() -> dict[str, str]:
    """Return the versions of the packages that the current distribution has released, by name.

    ``ROS_DISTRO`` names the distribution, and ``ROSDISTRO_INDEX_URL`` the index of all
    distributions, which is read from the network.

    Raises:
        OSError: The index cannot be read.
        LookupError: The index does not have the distribution.
    """
    from turtlewire.distro import current_distro

    name = os.environ.get("ROS_DISTRO") or str(current_distro())
    url = os.environ.get("ROSDISTRO_INDEX_URL") or _INDEX
    known = _document(url).get("distributions", {})
    if name not in known:
        raise LookupError(
            f"the index {url} has no distribution '{name}'; it has {', '.join(sorted(known))}"
        )
    versions = {}
    for path in known[name]["distribution"]:
        repositories = _document(urljoin(url, path)).get("repositories", {})
        for repository, description in repositories.items():
            release = description.get("release", {})
            # The number behind the hyphen counts the releases of the same version.
            version = str(release.get("version", "")).partition("-")[0]
            if version:
                versions.update(dict.fromkeys(release.get("packages", [repository]), version))
    return versions


def _document(url: str) -> dict[str, Any]:
    from urllib.request import urlopen

    import yaml

    with urlopen(url, timeout=_TIMEOUT_S) as answer:  # noqa: S310 - the user names the index
        read: dict[str, Any] = yaml.safe_load(answer.read())
    return read


def get_local_package_versions() -> dict[str, str]:
    """Return the versions of the installed packages by name, from their package.xml."""
    from turtlewire_ros.manifest import ManifestError, read_manifest
    from turtlewire_ros.prefix import package_names, share_directory

    versions = {}
    for name in package_names():
        # Of a package without a manifest, nothing is known.
        with suppress(ManifestError):
            path = Path(share_directory(name) or "", "package.xml")
            versions[name] = read_manifest(path).version
    return versions


def compare_versions(
    result: Result, local_packages: Mapping[str, str], distro_packages: Mapping[str, str]
) -> None:
    """Warn of packages that are older than the releases, and count the warnings.

    Args:
        result: Counts.
        local_packages: Versions of the installed packages by name.
        distro_packages: Versions of the released packages by name; other packages are left out.
    """
    for name, local in sorted(local_packages.items()):
        released = distro_packages.get(name)
        if released is not None and _numbers(local) < _numbers(released):
            result.add_warning()
            doctor_warn(
                f"{name} has been updated to a new version. local: {local} < latest: {released}"
            )


def _numbers(version: str) -> list[int]:
    return [int(number) for number in re.findall(r"\d+", version)]


class PackageCheck(DoctorCheck):
    """Checks that no installed package is older than the release of the distribution."""

    def category(self) -> str:
        return "package"

    def check(self) -> Result:
        """Read the index and compare; an index that cannot be read is an error."""
        result = Result()
        try:
            released = get_distro_package_versions()
        except (OSError, LookupError) as error:
            result.add_error()
            doctor_error(f"The versions of the released packages are not known: {error}")
            return result
        compare_versions(result, get_local_package_versions(), released)
        return result


class PackageReport(DoctorReport):
    """Reports the versions of the installed packages, and of their releases."""

    def category(self) -> str:
        return "package"

    def report(self) -> Report:
        """Report them; without the index, the local versions alone."""
        report = Report("PACKAGE VERSIONS")
        try:
            released = get_distro_package_versions()
        except (OSError, LookupError) as error:
            released = {}
            doctor_warn(f"The versions of the released packages are not known: {error}")
        for name, local in sorted(get_local_package_versions().items()):
            latest = f"latest={released[name]}, " if name in released else ""
            report.add_to_report(name, f"{latest}local={local}")
        return report
