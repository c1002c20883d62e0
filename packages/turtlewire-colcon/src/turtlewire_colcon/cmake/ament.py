"""ament's commands: packages, Python, ament's index, hooks of the environment, tests; xacro's.

xacro's CMake extras define ``xacro_add_files`` and its parts, and PyPI's xacro has none. A xacro
that is built in the workspace defines its own functions, which replace these.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from turtlewire_colcon.cmake.files import destination
from turtlewire_colcon.cmake.plan import (
    Install,
    Interfaces,
    PlannedTest,
    PythonModule,
    PythonPackage,
    Resource,
    Step,
)
from turtlewire_colcon.cmake.syntax import CMakeError, Parsed, parse_keywords

if TYPE_CHECKING:
    from turtlewire_colcon.cmake.interpreter import ExpandedCommand, Handler, Interpreter

__all__ = [
    "AMENT",
    "OWN_PARTS",
    "XACRO",
]

_RUN_XACRO = "import xacro; xacro.main()"


def _add_xacro_file(run: Interpreter, call: ExpandedCommand) -> None:
    parsed = parse_keywords(call.words, values=("OUTPUT",), lists=("REMAP", "DEPENDS"))
    output = parsed.rest[1] if len(parsed.rest) > 1 else ""
    path = _expand_file(run, call, parsed.rest[0], output, parsed.lists.get("REMAP", []))
    run.variables[parsed.values.get("OUTPUT", "XACRO_OUTPUT_FILE")] = path


def _xacro_install(run: Interpreter, call: ExpandedCommand) -> None:
    parsed = parse_keywords(call.words[1:], values=("DESTINATION",))
    _install(run, call, parsed.rest, parsed.values.get("DESTINATION", ""))


def _add_files(run: Interpreter, call: ExpandedCommand) -> None:
    parsed = parse_keywords(
        call.words, ("INSTALL",), ("OUTPUT", "TARGET", "DESTINATION"), ("REMAP", "DEPENDS")
    )
    remap = parsed.lists.get("REMAP", [])
    given = parsed.values.get("OUTPUT", "")
    paths = [_expand_file(run, call, word, given, remap) for word in parsed.rest]
    if "INSTALL" in parsed.options:
        _install(run, call, paths, parsed.values.get("DESTINATION", ""))


def _expand_file(
    run: Interpreter, call: ExpandedCommand, name: str, output: str, remap: list[str]
) -> str:
    """Plan the expansion of a file; returns the path of the result."""
    source = Path(run.source_path(name))
    if not source.is_file():
        raise CMakeError(call.place, f"{call.name}(): there is no file {source}")
    if not output and not name.endswith(".xacro"):
        raise CMakeError(call.place, f"{call.name}({name}): name the output, or the file .xacro")
    path = run.binary_path(output or name.removesuffix(".xacro"))
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    index = _index_of_sources(run)
    prefixes = os.pathsep.join(
        filter(None, (str(index), run.environment.get("AMENT_PREFIX_PATH", "")))
    )
    words = [sys.executable, "-m", "turtlewire_colcon.cmake.tool", "-E", "env"]
    words += [f"AMENT_PREFIX_PATH={prefixes}", sys.executable, "-c", _RUN_XACRO]
    folder = run.variables["CMAKE_CURRENT_SOURCE_DIR"]
    run.plan.steps.append(Step((*words, "-o", path, str(source), *remap), folder, call.place))
    return path


def _index_of_sources(run: Interpreter) -> Path:
    """Return a prefix in which ``$(find …)`` finds the package's sources before it is installed."""
    index = Path(run.variables["CMAKE_BINARY_DIR"]) / "ament_cmake_index"
    name = run.variables["PROJECT_NAME"]
    marker = index / "share" / "ament_index" / "resource_index" / "packages" / name
    marker.parent.mkdir(parents=True, exist_ok=True)
    marker.touch()
    share = index / "share" / name
    if not share.is_symlink():
        share.symlink_to(run.variables["CMAKE_SOURCE_DIR"])
    return index


def _install(run: Interpreter, call: ExpandedCommand, paths: list[str], folder: str) -> None:
    target = os.path.normpath(f"share/{run.variables['PROJECT_NAME']}/{folder}")
    run.plan.installs.append(Install("FILES", tuple(paths), target, call.place))


XACRO: dict[str, Handler] = {
    "xacro_add_xacro_file": _add_xacro_file,
    "xacro_install": _xacro_install,
    "xacro_add_files": _add_files,
}

_KINDS = ("msg", "srv", "action")
#: Commands whose mistakes are errors even in packages with C++: they install Python or data.
OWN_PARTS = (
    "ament_package", "ament_auto_package", "ament_python_install_package",
    "ament_python_install_module", "rosidl_generate_interfaces",
)  # fmt: skip
_WITHOUT_EFFECT = (
    "ament_export_dependencies", "ament_export_include_directories", "ament_export_libraries",
    "ament_export_interfaces", "ament_export_targets", "ament_export_definitions",
    "ament_export_link_flags", "ament_package_xml", "ament_lint_auto_find_test_dependencies",
    "rosidl_export_typesupport_libraries", "rosidl_export_typesupport_targets",
    "rosidl_default_generators", "ament_add_gtest", "ament_add_gmock",
    "ament_add_ros_isolated_gtest", "ament_add_ros_isolated_gmock",
    "ament_auto_find_test_dependencies", "ament_add_default_options", "stamp",
)  # fmt: skip
_TEST_OPTIONS = ("SKIP_TEST", "GENERATE_RESULT_FOR_RETURN_CODE_ZERO")
_TEST_VALUES = ("TIMEOUT", "WORKING_DIRECTORY", "TARGET", "PYTHON_EXECUTABLE", "RUNNER", "WERROR",
                "RESULT_FILE", "OUTPUT_FILE")  # fmt: skip
_TEST_LISTS = ("ENV", "APPEND_ENV", "APPEND_LIBRARY_DIRS", "COMMAND", "ARGS", "LABEL", "LABELS")
#: Seconds after which a test is stopped: of ament, and of add_test.
_TIMEOUT = 60.0
_CMAKE_TIMEOUT = 1500.0


def _find_package(run: Interpreter, call: ExpandedCommand) -> None:
    name = call.words[0]
    known = run.packages.is_known(name)
    run.variables[f"{name}_FOUND"] = "1" if known else "0"
    config = run.packages.config(name)
    if config is not None:
        run.variables[f"{name}_DIR"] = str(config.parent)
        run.run_file(config)
    if not known and "REQUIRED" in call.words and not run.testing:
        run.plan.missing.append(
            f"{call.place}: there is no package '{name}'{run.packages.advice(name)}"
        )


def _find_build_dependencies(run: Interpreter, _call: ExpandedCommand) -> None:
    for name in run.variables.get("AMENT_BUILD_DEPENDENCIES", "").split(";"):
        if name:
            run.variables[f"{name}_FOUND"] = "1" if run.packages.is_known(name) else "0"


def _package(run: Interpreter, call: ExpandedCommand) -> None:
    project, name = run.variables.get("PROJECT_NAME", ""), run.variables["AMENT_PACKAGE_NAME"]
    if project != name:
        raise CMakeError(
            call.place, f"{call.name}(): package.xml is of '{name}', and project() of '{project}'"
        )
    parsed = parse_keywords(
        call.words,
        options=("USE_SCOPED_HEADER_INSTALL_DIR",),
        lists=("CONFIG_EXTRAS", "CONFIG_EXTRAS_POST", "INSTALL_TO_SHARE", "INSTALL_TO_PATH"),
    )
    for keyword in ("CONFIG_EXTRAS", "CONFIG_EXTRAS_POST"):
        for word in parsed.lists.get(keyword, []):
            path = Path(run.source_path(word))
            if not path.is_file():
                raise CMakeError(call.place, f"{call.name}({keyword}): there is no file {path}")
            run.plan.extras.append(path)
    share = f"share/{project}"
    folders = parsed.lists.get("INSTALL_TO_SHARE", [])
    if folders:
        sources = tuple(run.source_path(word) for word in folders)
        run.plan.installs.append(Install("DIRECTORY", sources, share, call.place))


def _assert_file_exists(run: Interpreter, call: ExpandedCommand) -> None:
    path, *text = call.words
    if not os.path.exists(run.source_path(path)):
        raise CMakeError(call.place, "".join(text) or f"there is no file {path}")


def _python_package(run: Interpreter, call: ExpandedCommand) -> None:
    parsed = parse_keywords(
        call.words[1:],
        options=("SKIP_COMPILE",),
        values=("PACKAGE_DIR", "VERSION", "SETUP_CFG", "DESTINATION", "SCRIPTS_DESTINATION"),
    )
    name, given = call.words[0], parsed.values
    folder = Path(run.source_path(given.get("PACKAGE_DIR", name)))
    if not (folder / "__init__.py").is_file():
        what = f"no {folder / '__init__.py'}" if folder.is_dir() else f"no folder {folder}"
        raise CMakeError(call.place, f"{call.name}({name}): there is {what}")
    setup_cfg = Path(run.source_path(given.get("SETUP_CFG", "setup.cfg")))
    if "SETUP_CFG" in given and not setup_cfg.is_file():
        raise CMakeError(call.place, f"{call.name}({name}): there is no file {setup_cfg}")
    targets = {key: destination(run, given[key], call) for key in
               ("DESTINATION", "SCRIPTS_DESTINATION") if key in given}  # fmt: skip
    run.plan.python_packages.append(
        PythonPackage(
            name,
            folder,
            given.get("VERSION", run.plan.version),
            targets.get("DESTINATION", ""),
            setup_cfg if setup_cfg.is_file() else None,
            targets.get("SCRIPTS_DESTINATION", ""),
            call.place,
        )
    )


def _python_module(run: Interpreter, call: ExpandedCommand) -> None:
    parsed = parse_keywords(call.words, options=("SKIP_COMPILE",), values=("DESTINATION_SUFFIX",))
    path = Path(run.source_path(parsed.rest[0]))
    if not path.is_file():
        raise CMakeError(call.place, f"{call.name}(): there is no file {path}")
    run.plan.python_modules.append(
        PythonModule(path, parsed.values.get("DESTINATION_SUFFIX", ""), call.place)
    )


def _python_install_dir(run: Interpreter, call: ExpandedCommand) -> None:
    run.variables[call.words[0]] = run.variables["PYTHON_INSTALL_DIR"]


def _register_resource(run: Interpreter, call: ExpandedCommand) -> None:
    parsed = parse_keywords(
        call.words,
        options=("SKIP_INSTALL",),
        values=("CONTENT", "CONTENT_FILE", "PACKAGE_NAME"),
    )
    content = parsed.values.get("CONTENT", "")
    if "CONTENT_FILE" in parsed.values:
        path = Path(run.source_path(parsed.values["CONTENT_FILE"]))
        if not path.is_file():
            raise CMakeError(call.place, f"{call.name}(): there is no file {path}")
        content = path.read_text(encoding="utf-8")
    package = parsed.values.get("PACKAGE_NAME") or run.variables["PROJECT_NAME"]
    run.plan.resources.append(Resource(parsed.rest[0], package, content))


def _export_plugins(run: Interpreter, call: ExpandedCommand) -> None:
    """Install and register a description of plugins, as rqt's, which may be in Python."""
    category, relative = call.words[:2]
    package = run.variables["PROJECT_NAME"]
    share = f"share/{package}"
    folder = os.path.normpath(os.path.join(share, os.path.dirname(relative)))
    run.plan.installs.append(Install("FILES", (run.source_path(relative),), folder, call.place))
    kind, content = f"{category}__pluginlib__plugin", f"{share}/{relative}\n"
    earlier = [each for each in run.plan.resources if each[:2] == (kind, package)]
    for each in earlier:
        run.plan.resources.remove(each)
        content = each.content + content
    run.plan.resources.append(Resource(kind, package, content))


def _environment_hooks(run: Interpreter, call: ExpandedCommand) -> None:
    # Empty words are hooks that ament's variables name, which are for C++ libraries.
    for word in filter(None, call.words):
        path = Path(run.source_path(word))
        if not path.is_file():
            raise CMakeError(call.place, f"{call.name}(): there is no file {path}")
        run.plan.hooks.append(path)


def _generate_interfaces(run: Interpreter, call: ExpandedCommand) -> None:
    parsed = parse_keywords(
        call.words[1:],
        options=("ADD_LINTER_TESTS", "SKIP_INSTALL", "SKIP_GROUP_MEMBERSHIP_CHECK"),
        values=("LIBRARY_NAME",),
        lists=("DEPENDENCIES",),
    )
    for name in parsed.lists.get("DEPENDENCIES", []):
        if not run.packages.is_installed(name) and not run.testing:
            run.plan.missing.append(
                f"{call.place}: there is no package '{name}', on which the interfaces depend"
                f"{run.packages.advice(name)}"
            )
    files = tuple(_definition(run, word, call) for word in parsed.rest)
    if not files:
        raise CMakeError(call.place, f"{call.name}() names no files")
    run.plan.targets.add(call.words[0])
    skipped = "SKIP_INSTALL" in parsed.options
    package = run.variables["PROJECT_NAME"]
    run.plan.interfaces.append(Interfaces(package, files, not skipped, call.place))


def _definition(run: Interpreter, word: str, call: ExpandedCommand) -> tuple[str, Path]:
    """Return a definition's path in the package, and on disk; ``<folder>:msg/A.msg`` names both."""
    base, colon, relative = word.rpartition(":")
    if colon and len(base) > 1:  # not the drive of C:/a
        path = Path(run.source_path(os.path.join(base, relative)))
    else:
        path = Path(run.source_path(word))
        relative = f"{path.parent.name}/{path.name}"
    folder, _, name = relative.rpartition("/")
    kind = folder.rpartition("/")[2]
    if kind not in _KINDS or not name.endswith((f".{kind}", ".idl")):
        raise CMakeError(
            call.place,
            f"{call.name}(): {word} is not a msg/….msg, srv/….srv, action/….action or .idl",
        )
    if not path.is_file():
        raise CMakeError(call.place, f"{call.name}(): there is no file {path}")
    return f"{kind}/{name}", path


def _add_pytest_test(run: Interpreter, call: ExpandedCommand) -> None:
    name, word, *_ = call.words
    _add_test(run, call, "pytest", name, (_test_path(run, call, word),))


def _add_launch_test(run: Interpreter, call: ExpandedCommand) -> None:
    path = _test_path(run, call, call.words[0])
    parsed = _test_arguments(call)
    stem = os.path.relpath(path, run.variables["CMAKE_CURRENT_SOURCE_DIR"]).replace("/", "_")
    name = parsed.values.get("TARGET", stem)
    _add_test(run, call, "launch", name, (path, *parsed.lists.get("ARGS", [])))


def _test_path(run: Interpreter, call: ExpandedCommand, word: str) -> str:
    path = run.source_path(word)
    if not os.path.exists(path):
        raise CMakeError(call.place, f"{call.name}(): there is no file {path}")
    return path


def _add_command_test(run: Interpreter, call: ExpandedCommand) -> None:
    parsed = parse_keywords(call.words, values=("NAME",), lists=_TEST_LISTS)
    name = parsed.values.get("NAME") or parsed.rest[0]
    command = tuple(parse_keywords(call.words, _TEST_OPTIONS, _TEST_VALUES, _TEST_LISTS)
                    .lists.get("COMMAND", []))  # fmt: skip
    if command and command[0] not in run.plan.targets and "$<" not in command[0]:
        _add_test(run, call, "command", name, command)


def _add_test(
    run: Interpreter, call: ExpandedCommand, kind: str, name: str, words: tuple[str, ...]
) -> None:
    parsed = _test_arguments(call)
    if "SKIP_TEST" in parsed.options:
        return
    lines = parsed.lists.get("ENV", []) + parsed.lists.get("APPEND_ENV", [])
    # CMake's own command runs tests in the build folder, ament's commands in the source folder.
    plain = call.name == "add_test"
    default = "CMAKE_CURRENT_BINARY_DIR" if plain else "CMAKE_SOURCE_DIR"
    folder = parsed.values.get("WORKING_DIRECTORY", run.variables[default])
    environment = dict(line.split("=", 1) for line in lines)
    timeout = float(parsed.values.get("TIMEOUT", _CMAKE_TIMEOUT if plain else _TIMEOUT))
    # The runner, and the commands that use it, come from ament_cmake_ros.
    runner = parsed.values.get("RUNNER", "")
    isolated = runner.endswith("run_test_isolated.py") or "_ros_isolated_" in call.name
    run.plan.tests.append(
        PlannedTest(name, kind, words, environment, run.source_path(folder), timeout, isolated)
    )


def _test_arguments(call: ExpandedCommand) -> Parsed:
    return parse_keywords(call.words[1:], _TEST_OPTIONS, _TEST_VALUES, _TEST_LISTS)


def _nothing(_run: Interpreter, _call: ExpandedCommand) -> None:
    """Do nothing: the command only matters for linking against the package."""


AMENT: dict[str, Handler] = {
    **dict.fromkeys(_WITHOUT_EFFECT, _nothing),
    "find_package": _find_package,
    "ament_auto_find_build_dependencies": _find_build_dependencies,
    "assert_file_exists": _assert_file_exists,
    "ament_package": _package,
    "ament_auto_package": _package,
    "ament_python_install_package": _python_package,
    "ament_python_install_module": _python_module,
    "ament_get_python_install_dir": _python_install_dir,
    "ament_index_register_resource": _register_resource,
    "ament_environment_hooks": _environment_hooks,
    "pluginlib_export_plugin_description_file": _export_plugins,
    "rosidl_generate_interfaces": _generate_interfaces,
    "ament_add_pytest_test": _add_pytest_test,
    "ament_add_ros_isolated_pytest_test": _add_pytest_test,
    "add_launch_test": _add_launch_test,
    "add_ros_test": _add_launch_test,
    "ament_add_test": _add_command_test,
    "ament_add_ros_isolated_test": _add_command_test,
    "add_test": _add_command_test,
}
