"""Installs what a package's CMakeLists.txt names: files, Python packages, interfaces, the index."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterator
from configparser import ConfigParser
from pathlib import Path
from shutil import copyfile, copymode
from typing import TYPE_CHECKING, NamedTuple

from rosidl_adapter.idl import interface_to_idl
from rosidl_adapter.parser import InvalidSpecification, InvalidValue
from turtlewire.msg.idl import idl_to_text
from turtlewire_colcon.cmake.basics import configured
from turtlewire_colcon.cmake.syntax import CMakeError
from turtlewire_colcon.package_lookup import CONFIG_MARK
from turtlewire_ros.prefix import COMPILED_TARGETS

if TYPE_CHECKING:
    from turtlewire_colcon.cmake.interpreter import Interpreter
    from turtlewire_colcon.cmake.plan import FileRule, Install, Plan, PythonPackage
    from turtlewire_colcon.cmake.syntax import SourcePosition

__all__ = ["BuildCommand", "PlanInstaller", "build_commands", "entry_points"]

_IGNORED = ("__pycache__", ".pyc")
_SCRIPT = "#!{python}\nimport sys\n\nfrom {module} import {function}\n\nsys.exit({call}())\n"
_METADATA = "Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n"
_HOOKS = """# written by turtlewire: hooks of the environment find here what ament gives them
AMENT_CURRENT_PREFIX="$COLCON_CURRENT_PREFIX"
ament_prepend_unique_value() {{
  eval "_turtlewire_value=\\"\\${{$1:-}}\\""
  case ":$_turtlewire_value:" in
    *":$2:"*) ;;
    *) eval "export $1=\\"$2${{_turtlewire_value:+:$_turtlewire_value}}\\"" ;;
  esac
}}
ament_append_unique_value() {{
  eval "_turtlewire_value=\\"\\${{$1:-}}\\""
  case ":$_turtlewire_value:" in
    *":$2:"*) ;;
    *) eval "export $1=\\"${{_turtlewire_value:+$_turtlewire_value:}}$2\\"" ;;
  esac
}}
{lines}
unset -f ament_prepend_unique_value ament_append_unique_value
unset AMENT_CURRENT_PREFIX _turtlewire_value
"""


class BuildCommand(NamedTuple):
    """A command that runs before the installation.

    Attributes:
        words: The command.
        folder: Where it runs.
        may_fail: True for a step of a package with C++: it may need what is not compiled.
    """

    words: list[str]
    folder: str
    may_fail: bool = False


def build_commands(plan: Plan, build: Path, modules: Path) -> Iterator[BuildCommand]:
    """Yield the commands to run before the installation.

    They generate interfaces, whose definitions are put into ``build``, and run the plan's steps.

    Args:
        plan: The plan.
        build: The build folder.
        modules: The folder of Python packages. What ``SKIP_INSTALL`` keeps out of it is generated
            in ``build/rosidl_generator_py``, which tests have on their path.
    """
    for installed in (True, False):
        files = [
            file for part in plan.interfaces if part.installed is installed for file in part.files
        ]
        if not files:
            continue
        folder = build / ("rosidl_adapter" if installed else "rosidl_adapter_tests") / plan.name
        for path in [*folder.rglob("*")] if folder.is_dir() else []:
            if path.is_file():
                path.unlink()
        for relative, source in files:
            _replace_by_copy(source, folder / relative)
        output = modules if installed else build / "rosidl_generator_py"
        command = [sys.executable, "-m", "turtlewire_ros.generate_interfaces", str(folder)]
        yield BuildCommand([*command, "--output", str(output), "--package", plan.name], str(build))
    for step in plan.steps:
        Path(step.folder).mkdir(parents=True, exist_ok=True)
        yield BuildCommand(list(step.words), step.folder, may_fail=bool(plan.compiled))


def entry_points(setup_cfg: Path | None) -> dict[str, dict[str, str]]:
    """Entry points of a setup.cfg, by group: ``{"console_scripts": {"xacro": "xacro:main"}}``."""
    if setup_cfg is None:
        return {}
    parser = ConfigParser(delimiters=("=",), interpolation=None)
    parser.optionxform = str  # type: ignore[assignment,method-assign] # names keep their case
    parser.read(setup_cfg, encoding="utf-8")
    section = "options.entry_points"
    groups: dict[str, dict[str, str]] = {}
    for group, text in parser.items(section) if parser.has_section(section) else ():
        pairs = (line.partition("=") for line in text.splitlines() if "=" in line)
        groups[group] = {name.strip(): target.strip() for name, _, target in pairs}
    return groups


class PlanInstaller:
    """Installs a plan below a prefix.

    Attributes:
        warnings: One line for each file of a package with C++ that is missing after `install`.

    Args:
        plan: What is installed.
        run: The interpreter that made it; its variables are written into templates.
        source: The package's folder.
        prefix: Where it goes.
        modules: The prefix's folder of Python packages.
        symlink: Whether links to the sources are installed instead of copies.
        python: What the first line of console scripts names.
    """

    def __init__(
        self,
        plan: Plan,
        run: Interpreter,
        source: Path,
        prefix: Path,
        modules: Path,
        *,
        symlink: bool = False,
        python: str = sys.executable,
    ) -> None:
        self.warnings: list[str] = []
        self._plan = plan
        self._run = run
        self._source = source
        self._prefix = prefix
        self._modules = modules
        self._symlink = symlink
        self._python = python
        self._share = prefix / "share" / plan.name

    def install(self) -> list[str]:
        """Install everything but generated modules of interfaces.

        Returns:
            The package's hooks of the environment, relative to the prefix.

        Raises:
            CMakeError: A file that a command names is missing, in a package without C++.
            OSError: A file cannot be written.
        """
        for package in self._plan.python_packages:
            self._make_scripts(package)
        for install in self._plan.installs:
            self._install(install)
        for package in self._plan.python_packages:
            self._install_python(package)
        for module in self._plan.python_modules:
            self._put(module.file, self._modules / module.suffix / module.file.name)
        for interfaces in self._plan.interfaces:
            for relative, path in interfaces.files if interfaces.installed else ():
                self._put(path, self._share / relative)
                self._put_translation(relative, path, interfaces.place)
        self._put(self._source / "package.xml", self._share / "package.xml")
        self._register()
        self._install_extras()
        hooks = self._install_hooks()
        for text, place in self._plan.install_code:
            self._run.run_text(text, place)
        return hooks

    def _miss(self, install: Install, path: Path) -> None:
        fault = CMakeError(install.place, f"install({install.kind}): there is no {path}")
        if not self._plan.compiled:
            raise fault
        # Headers and libraries in the build folder come from targets, which are left out.
        self.warnings.append(str(fault))

    def _install(self, install: Install) -> None:
        target = self._prefix / install.destination
        for name in install.sources:
            path = Path(name)
            if not path.exists():
                if install.optional:
                    continue
                self._miss(install, path)
                continue
            if install.kind == "DIRECTORY":
                inner = target if name.endswith("/") else target / path.name
                self._install_directory(path, inner, install, "")
            elif path.is_dir():
                raise CMakeError(
                    install.place, f"install({install.kind}): {path} is a folder (DIRECTORY …)"
                )
            else:
                self._put(
                    path,
                    target / (install.rename or path.name),
                    executable=install.kind == "PROGRAMS",
                )

    def _install_directory(self, source: Path, target: Path, install: Install, inside: str) -> None:
        target.mkdir(parents=True, exist_ok=True)
        for path in sorted(source.iterdir()):
            relative = f"{inside}/{path.name}"
            rule = _rule_for(f"/{source.name}{relative}", install.rules)
            if rule is not None and rule.excludes:
                continue
            if path.is_dir():
                self._install_directory(path, target / path.name, install, relative)
            elif rule is not None or not install.only_matching:
                self._put(path, target / path.name)

    def _install_python(self, package: PythonPackage) -> None:
        base = self._prefix / package.destination if package.destination else self._modules
        for path in sorted(package.folder.rglob("*")):
            relative = path.relative_to(package.folder)
            if path.is_file() and not any(part.endswith(_IGNORED) for part in relative.parts):
                self._put(path, base / package.name / relative)
        version = f"py{sys.version_info.major}.{sys.version_info.minor}"
        info = base / f"{package.name}-{package.version}-{version}.egg-info"
        info.mkdir(parents=True, exist_ok=True)
        (info / "PKG-INFO").write_text(
            _METADATA.format(name=package.name, version=package.version), encoding="utf-8"
        )
        (info / "top_level.txt").write_text(f"{package.name}\n", encoding="utf-8")
        groups = entry_points(package.setup_cfg)
        lines = [
            line
            for group, entries in groups.items()
            for line in (f"[{group}]", *(f"{name} = {to}" for name, to in entries.items()), "")
        ]
        (info / "entry_points.txt").write_text("\n".join(lines), encoding="utf-8")
        for script in sorted(self._scripts_of(package).iterdir()) if package.scripts else ():
            _replace_by_copy(script, self._prefix / package.scripts / script.name)

    def _make_scripts(self, package: PythonPackage) -> None:
        """Make the console scripts where ament does, from where packages install them again."""
        if not package.scripts:
            return
        folder = self._scripts_of(package)
        folder.mkdir(parents=True, exist_ok=True)
        for name, target in entry_points(package.setup_cfg).get("console_scripts", {}).items():
            module, _, call = target.partition(":")
            text = _SCRIPT.format(
                python=self._python, module=module, function=call.partition(".")[0], call=call
            )
            (folder / name).write_text(text, encoding="utf-8")
            (folder / name).chmod(0o755)

    def _scripts_of(self, package: PythonPackage) -> Path:
        binary = Path(self._run.variables["CMAKE_BINARY_DIR"])
        return binary / "ament_cmake_python" / package.name / "scripts"

    def _register(self) -> None:
        index = self._prefix / "share" / "ament_index" / "resource_index"
        listed = sorted(
            {
                name
                for interfaces in self._plan.interfaces
                if interfaces.installed
                for relative, _ in interfaces.files
                for name in (relative, f"{relative.rpartition('.')[0]}.idl")
            }
        )
        entries = [("packages", self._plan.name, "")]
        entries += [("rosidl_interfaces", self._plan.name, "\n".join(listed))] if listed else []
        compiled = sorted({target.name for target in self._plan.compiled})
        entries += [(COMPILED_TARGETS, self._plan.name, "\n".join(compiled))] if compiled else []
        for kind, package, content in (*entries, *self._plan.resources):
            (index / kind).mkdir(parents=True, exist_ok=True)
            (index / kind / package).write_text(content, encoding="utf-8")

    def _install_extras(self) -> None:
        """Install CMake files that ``find_package`` of packages built later runs."""
        if not self._plan.extras:
            return
        lines = [CONFIG_MARK]
        for path in self._plan.extras:
            name = path.name.removesuffix(".in")
            self._put_template(path, self._share / "cmake" / name)
            lines.append(f'include("${{CMAKE_CURRENT_LIST_DIR}}/{name}")')
        config = self._share / "cmake" / f"{self._plan.name}Config.cmake"
        config.write_text("\n".join([*lines, ""]), encoding="utf-8")

    def _install_hooks(self) -> list[str]:
        hooks = []
        for path in self._plan.hooks:
            target = self._share / "environment" / path.name.removesuffix(".in")
            self._put_template(path, target)
            hooks.append(target.relative_to(self._prefix).as_posix())
        return [*self._wrap_hooks(hooks), *(hook for hook in hooks if hook.endswith(".dsv"))]

    def _wrap_hooks(self, hooks: list[str]) -> list[str]:
        """Scripts that source hooks, with the variable and functions that ament gives them."""
        wrappers = []
        for shell in ("sh", "bash", "zsh"):
            lines = [
                f'. "$AMENT_CURRENT_PREFIX/{hook}"' for hook in hooks if hook.endswith(f".{shell}")
            ]
            if lines:
                path = self._share / f"local_setup.{shell}"
                path.write_text(_HOOKS.format(lines="\n".join(lines)), encoding="utf-8")
                wrappers.append(path.relative_to(self._prefix).as_posix())
        return wrappers

    def _put_translation(self, relative: str, path: Path, place: SourcePosition) -> None:
        """Install what an .idl file means as .msg, .srv or .action, or what one of those is in IDL.

        All tools here read the former, and some programs the latter.
        """
        source, text = Path(relative), path.read_text(encoding="utf-8")
        kind = source.parent.name
        if source.suffix == ".idl":
            translated = idl_to_text(f"{self._plan.name}/{kind}/{source.stem}", text)
            target = source.with_suffix(f".{kind}")
        else:
            try:
                translated = interface_to_idl(self._plan.name, source, text)
            except (NameError, TypeError, ValueError, InvalidSpecification, InvalidValue) as error:
                raise CMakeError(place, f"{path}: {error}") from error
            target = source.with_suffix(".idl")
        _remove(self._share / target)
        (self._share / target).write_text(translated, encoding="utf-8")

    def _put_template(self, source: Path, target: Path) -> None:
        if source.suffix != ".in":
            self._put(source, target)
            return
        target.parent.mkdir(parents=True, exist_ok=True)
        text = configured(self._run, source.read_text(encoding="utf-8"), at_only=True)
        target.write_text(text, encoding="utf-8")

    def _put(self, source: Path, target: Path, *, executable: bool = False) -> None:
        if self._symlink and (not executable or os.access(source, os.X_OK)):
            _remove(target)
            target.symlink_to(source.absolute())
            return
        _replace_by_copy(source, target)
        if executable:
            target.chmod(0o755)


def _rule_for(path: str, rules: tuple[FileRule, ...]) -> FileRule | None:
    """Return the rule that decides on a path: one that excludes wins over others."""
    matching = [rule for rule in rules if re.search(rule.expression, path)]
    return next((rule for rule in matching if rule.excludes), matching[0] if matching else None)


def _remove(target: Path) -> None:
    """Make room for a file: it may be a link to a source, which must not be overwritten."""
    target.parent.mkdir(parents=True, exist_ok=True)
    if target.is_symlink() or target.is_file():
        target.unlink()


def _replace_by_copy(source: Path, target: Path) -> None:
    _remove(target)
    copyfile(source, target)
    copymode(source, target)
