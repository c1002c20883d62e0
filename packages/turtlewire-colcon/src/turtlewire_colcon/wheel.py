"""Builds the wheel of an ament_cmake package without C++, for pip.

Files for a prefix go into the environment: a virtual environment with turtlewire is a prefix, in
which ``ros2 run`` and launch files find the package.
"""

from __future__ import annotations

import base64
import hashlib
import os
import subprocess
import tempfile
import zipfile
from collections.abc import Callable, Iterable, Mapping
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from typing import TYPE_CHECKING

from turtlewire.errors import InterfaceError
from turtlewire_colcon.cmake.evaluate import evaluate_package
from turtlewire_colcon.cmake.syntax import CMakeError
from turtlewire_colcon.plan_install import PlanInstaller, build_commands, entry_points
from turtlewire_ros.manifest import Manifest, ManifestError, read_manifest

if TYPE_CHECKING:
    from turtlewire_colcon.cmake.plan import Plan

__all__ = ["WheelError", "build_package_wheels"]

_MODULES = "site-packages"
_WHEEL = "Wheel-Version: 1.0\nGenerator: turtlewire\nRoot-Is-Purelib: true\nTag: py3-none-any\n"


class WheelError(Exception):
    """A package cannot become a wheel; the text has a line for each reason."""


def build_package_wheels(
    sources: Iterable[Path],
    output: Path,
    warn: Callable[[str], None],
    begin: Callable[[str], None] = lambda _: None,
) -> list[Path]:
    """Build the wheels of packages, each after those that it needs.

    A package finds the others of the same call, also those that are not installed.

    Args:
        sources: The packages' folders, in any order.
        output: The folder for the wheels.
        warn: Called with each line of warning, as when C++ is left out.
        begin: Called with the name of each package before its build.

    Returns:
        The wheels, in the order in which they were built.

    Raises:
        WheelError: A package cannot be installed, or packages depend on each other in a cycle.
    """
    wheels = []
    environment = dict(os.environ)
    with tempfile.TemporaryDirectory(prefix="turtlewire-wheel-") as folder:
        try:
            for source, manifest in _in_order_of_need(sources):
                begin(manifest.name)
                base = Path(folder) / manifest.name
                plan = _install(source, base / "build", base / "prefix", warn, environment)
                wheels.append(_pack(manifest, plan, base / "prefix", output))
                _add_prefix(environment, base / "prefix")
        except (CMakeError, InterfaceError, ManifestError, OSError) as error:
            raise WheelError(str(error)) from error
    return wheels


def _in_order_of_need(sources: Iterable[Path]) -> list[tuple[Path, Manifest]]:
    """Folders and manifests of packages, each after the packages that its build needs."""
    packages: dict[str, tuple[Path, Manifest]] = {}
    for source in sources:
        if not source.is_dir():
            raise WheelError(f"there is no folder {source}")
        manifest = read_manifest(source.resolve() / "package.xml")
        if manifest.name in packages:
            other, _ = packages[manifest.name]
            raise WheelError(f"{other} and {source} are both called {manifest.name}")
        packages[manifest.name] = source, manifest
    needs = {
        name: [other for other in manifest.build_dependencies if other in packages]
        for name, (_, manifest) in packages.items()
    }
    try:
        order = [*TopologicalSorter(needs).static_order()]
    except CycleError as error:
        circle = " needs ".join(reversed(error.args[1]))
        raise WheelError(f"packages depend on each other in a cycle: {circle}") from error
    return [packages[name] for name in order]


def _add_prefix(environment: dict[str, str], prefix: Path) -> None:
    """Let the next builds find packages installed below a prefix."""
    for variable, folder in (
        ("AMENT_PREFIX_PATH", prefix),
        ("PYTHONPATH", prefix / _MODULES),
        ("PATH", prefix / "bin"),
    ):
        paths = (str(folder), environment.get(variable, ""))
        environment[variable] = os.pathsep.join(filter(None, paths))


def _install(
    source: Path,
    build: Path,
    prefix: Path,
    warn: Callable[[str], None],
    environment: Mapping[str, str],
) -> Plan:
    source = source.resolve()
    if not (source / "CMakeLists.txt").is_file():
        raise WheelError(f"{source} is not an ament_cmake package: it has no CMakeLists.txt")
    plan, interpreter = evaluate_package(source, build, prefix, _MODULES, environment)
    errors, warnings = plan.verdict()
    if errors:
        raise WheelError("\n".join(errors))
    for line in warnings:
        warn(line)
    modules = prefix / _MODULES
    for command in build_commands(plan, build, modules):
        # Our own module, or what the package itself runs.
        done = subprocess.run(  # noqa: S603
            command.words,
            cwd=command.folder,
            env=environment,
            check=False,
            capture_output=True,
            text=True,
        )
        text = done.stderr.strip() or f"{' '.join(command.words)} failed"
        if done.returncode and not command.may_fail:
            raise WheelError(text)
        if done.returncode:
            warn(text)
    installer = PlanInstaller(
        plan, interpreter, source, prefix, modules, python="/usr/bin/env python3"
    )
    installer.install()
    for line in installer.warnings:
        warn(line)
    # Without it, colcon treats a venv in a workspace as sources.
    (prefix / "share" / plan.name / "COLCON_IGNORE").touch()
    return plan


def _pack(manifest: Manifest, plan: Plan, prefix: Path, output: Path) -> Path:
    base = f"{manifest.name.replace('-', '_')}-{manifest.version}"
    path = output / f"{base}-py3-none-any.whl"
    output.mkdir(parents=True, exist_ok=True)
    record = []
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:

        def add(name: str, data: bytes, mode: int = 0o644) -> None:
            entry = zipfile.ZipInfo(name)
            entry.external_attr = (0o100000 | mode) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode().rstrip("=")
            record.append(f"{name},sha256={digest},{len(data)}\n")

        for file in sorted(prefix.rglob("*")):
            name = _place(file.relative_to(prefix), f"{base}.data")
            if file.is_file() and name:
                add(name, file.read_bytes(), file.stat().st_mode & 0o777)
        for name, text in _metadata(manifest, plan).items():
            add(f"{base}.dist-info/{name}", text.encode())
        record.append(f"{base}.dist-info/RECORD,,\n")
        archive.writestr(f"{base}.dist-info/RECORD", "".join(record))
    return path


def _place(relative: Path, data: str) -> str:
    """Return the path in the wheel of a file of the prefix; empty if it is left out."""
    first, *rest = relative.parts
    if first == _MODULES:
        return "" if rest and rest[0].endswith(".egg-info") else "/".join(rest)
    if first == "bin" and rest:
        return "/".join([data, "scripts", *rest])
    return "/".join([data, "data", first, *rest])


def _metadata(manifest: Manifest, plan: Plan) -> dict[str, str]:
    groups: dict[str, dict[str, str]] = {}
    for package in plan.python_packages:
        for group, entries in entry_points(package.setup_cfg).items():
            if group != "console_scripts":  # they are files in lib/<package>
                groups.setdefault(group, {}).update(entries)
    lines = [
        f"[{group}]\n" + "".join(f"{name} = {target}\n" for name, target in entries.items())
        for group, entries in groups.items()
    ]
    files = {
        "METADATA": (
            f"Metadata-Version: 2.1\nName: {manifest.name}\nVersion: {manifest.version}\n"
            f"Summary: {manifest.description}\n"
        ),
        "WHEEL": _WHEEL,
    }
    return files | ({"entry_points.txt": "\n".join(lines)} if lines else {})
