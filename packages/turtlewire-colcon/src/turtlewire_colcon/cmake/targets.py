"""Commands that would compile C++, and commands that only affect such targets."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire_colcon.cmake.plan import CompiledTarget
from turtlewire_colcon.cmake.syntax import CMakeError

if TYPE_CHECKING:
    from turtlewire_colcon.cmake.interpreter import ExpandedCommand, Handler, Interpreter

__all__ = ["ROS_1", "TARGETS"]

#: Their first argument is the name of what they compile.
_COMPILING = (
    "add_executable",
    "pybind11_add_module",
    "nanobind_add_module",
    "python_add_library",
    "python3_add_library",
    "cuda_add_executable",
    "cuda_add_library",
    "rosidl_generator_cpp",
    "ament_auto_add_executable",
    "ament_auto_add_library",
    "generate_parameter_library",
    "externalproject_add",
    "fetchcontent_makeavailable",
    "ament_vendor",
    "rclcpp_components_register_node",
    "rclcpp_components_register_nodes",
)
_NOT_COMPILED = frozenset({"INTERFACE", "ALIAS", "IMPORTED"})
#: Commands about the compiler, its targets, and other ways to find them.
_WITHOUT_EFFECT = (
    "cmake_minimum_required", "cmake_policy", "enable_testing", "enable_language", "include_guard",
    "mark_as_advanced", "include_directories", "link_directories", "link_libraries",
    "add_compile_options", "add_compile_definitions", "add_definitions", "add_link_options",
    "add_dependencies", "target_include_directories", "target_link_libraries", "target_sources",
    "target_compile_definitions", "target_compile_features", "target_compile_options",
    "target_link_options", "target_link_directories", "target_precompile_headers",
    "set_target_properties", "set_property", "get_property", "get_target_property",
    "set_source_files_properties", "set_tests_properties", "set_directory_properties",
    "generate_export_header", "export", "configure_package_config_file",
    "write_basic_package_version_file", "check_cxx_compiler_flag", "pkg_check_modules",
    "pkg_search_module", "find_library", "find_path", "find_program", "find_file", "source_group",
    "ament_target_dependencies", "pluginlib_enable_plugin_testing", "rosidl_target_interfaces",
    "check_include_file", "check_include_file_cxx", "check_symbol_exists",
    "check_cxx_symbol_exists", "check_function_exists", "check_c_compiler_flag",
    "check_cxx_source_compiles",
    "find_package_handle_standard_args", "fetchcontent_declare", "define_property",
    "class_loader_hide_library_symbols", "ament_generate_version_header", "ament_export_build_info",
    "aux_source_directory", "get_directory_property", "get_cmake_property",
    "rosidl_get_typesupport_target", "qt5_wrap_cpp", "qt5_wrap_ui", "qt5_add_resources",
)  # fmt: skip
#: Commands of ROS 1.
ROS_1 = (
    "catkin_package", "catkin_python_setup", "catkin_install_python", "catkin_add_nosetests",
    "catkin_add_gtest", "add_message_files", "add_service_files", "add_action_files",
    "generate_messages", "add_rostest",
)  # fmt: skip


def _leave_out(run: Interpreter, call: ExpandedCommand) -> None:
    if not call.words:
        raise CMakeError(call.place, f"{call.name}() needs a name")
    run.plan.targets.add(call.words[0])
    if not run.testing:
        names = [call.words[0]]
        if "EXECUTABLE" in call.words[:-1]:  # what rclcpp_components makes of a library
            names.append(call.words[call.words.index("EXECUTABLE") + 1])
        run.plan.compiled += [CompiledTarget(name, call.place) for name in names]


def _add_library(run: Interpreter, call: ExpandedCommand) -> None:
    if _NOT_COMPILED & set(call.words[1:2]) or "IMPORTED" in call.words:
        run.plan.targets.add(call.words[0])
    else:
        _leave_out(run, call)


def _nothing(_run: Interpreter, _call: ExpandedCommand) -> None:
    """Do nothing: the command concerns compiled targets only."""


def _refuse_catkin(_run: Interpreter, call: ExpandedCommand) -> None:
    raise CMakeError(call.place, f"{call.name}() is of ROS 1, whose packages do not run here")


TARGETS: dict[str, Handler] = {
    **dict.fromkeys(_WITHOUT_EFFECT, _nothing),
    **dict.fromkeys(_COMPILING, _leave_out),
    "add_library": _add_library,
    **dict.fromkeys(ROS_1, _refuse_catkin),
}
