"""Files of new packages in C++ and Rust, whose programs are built and run next to a real ROS 2."""

from __future__ import annotations

from collections.abc import Sequence

_CPP_NODE = """#include <iostream>

int main()
{{
  std::cout << "Hi from {name}." << std::endl;
  return 0;
}}
"""

_CPP_HEADER = """#ifndef {guard}
#define {guard}

#include <string>

namespace {name}
{{

/// Greets.
class {kind}
{{
public:
  /// Return the greeting.
  std::string greeting() const;
}};

}}  // namespace {name}

#endif  // {guard}
"""

_CPP_SOURCE = """#include "{name}/{library}.hpp"

namespace {name}
{{

std::string {kind}::greeting() const
{{
  return "Hi from {name}.";
}}

}}  // namespace {name}
"""

_HEAD = """cmake_minimum_required(VERSION 3.8)
project({name})

{packages}"""

_LIBRARY = """
add_library({library} src/{library}.cpp)
target_compile_features({library} PUBLIC cxx_std_17)
{links}target_include_directories({library} PUBLIC
  "$<BUILD_INTERFACE:${{CMAKE_CURRENT_SOURCE_DIR}}/include>"
  "$<INSTALL_INTERFACE:include/${{PROJECT_NAME}}>")
set_target_properties({library} PROPERTIES WINDOWS_EXPORT_ALL_SYMBOLS ON)
install(DIRECTORY include/ DESTINATION include/${{PROJECT_NAME}})
install(TARGETS {library}
  EXPORT export_${{PROJECT_NAME}}
  ARCHIVE DESTINATION lib
  LIBRARY DESTINATION lib
  RUNTIME DESTINATION bin)
"""

_EXECUTABLE = """
add_executable({node} src/{node}.cpp)
target_compile_features({node} PUBLIC cxx_std_17)
{links}install(TARGETS {node} DESTINATION lib/${{PROJECT_NAME}})
"""

_EXPORT = """
install(EXPORT export_${PROJECT_NAME}
  NAMESPACE ${PROJECT_NAME}::
  FILE ${PROJECT_NAME}Config.cmake
  DESTINATION share/${PROJECT_NAME}/cmake)
"""

_AMENT_EXPORT = """
ament_export_targets(export_${{PROJECT_NAME}} HAS_LIBRARY_TARGET)
{dependencies}"""

_CARGO = """[package]
name = "{name}"
version = "{version}"
edition = "2021"
description = {description}
license = {license}
"""

_RUST_LIBRARY = """/// Return the greeting.
pub fn greeting() -> &'static str {{
    "Hi from {name}."
}}
"""

_RUST_NODE = """fn main() {{
    println!("Hi from {name}.");
}}
"""


def cpp_node(name: str) -> str:
    """Return the source of a program of a package."""
    return _CPP_NODE.format(name=name)


def cpp_header(name: str, library: str) -> str:
    """Return the header of a library of a package."""
    guard = f"{name}__{library}_HPP_".upper()
    return _CPP_HEADER.format(name=name, kind=_class_name(library), guard=guard)


def cpp_source(name: str, library: str) -> str:
    """Return the source of a library of a package."""
    return _CPP_SOURCE.format(name=name, library=library, kind=_class_name(library))


def cmake_lists(
    name: str, dependencies: Sequence[str], node: str | None, library: str | None
) -> str:
    """Return the CMakeLists.txt of a package that CMake builds alone.

    Args:
        name: Name of the package.
        dependencies: Packages to find.
        node: Name of an executable, or None.
        library: Name of a library, or None.
    """
    end = _EXPORT if library else ""
    return _head(name, dependencies) + _targets(node, library) + end


def ament_cmake_lists(
    name: str, dependencies: Sequence[str], node: str | None, library: str | None
) -> str:
    """Return the CMakeLists.txt of an ament_cmake package, like `cmake_lists`.

    The library and the executable are linked with the targets that the dependencies export.
    """
    others = [each for each in dependencies if each != "ament_cmake"]
    exported = f"ament_export_dependencies({' '.join(others)})\n" if others else ""
    end = _AMENT_EXPORT.format(dependencies=exported) if library else ""
    # Packages of ament list their targets in this variable.
    linked = [f"${{{each}_TARGETS}}" for each in others]
    head = _head(name, ["ament_cmake", *others])
    return f"{head}{_targets(node, library, linked)}{end}\nament_package()\n"


def _head(name: str, dependencies: Sequence[str]) -> str:
    packages = "".join(f"find_package({each} REQUIRED)\n" for each in dependencies)
    return _HEAD.format(name=name, packages=packages)


def _targets(node: str | None, library: str | None, linked: Sequence[str] = ()) -> str:
    made = _LIBRARY.format(library=library, links=_links(library, linked)) if library else ""
    if node:
        of_node = [library, *linked] if library else linked
        made += _EXECUTABLE.format(node=node, links=_links(node, of_node))
    return made


def _links(target: str, linked: Sequence[str]) -> str:
    return f"target_link_libraries({target} PUBLIC {' '.join(linked)})\n" if linked else ""


def cargo_manifest(
    name: str, version: str, description: str, license_name: str, library: str | None
) -> str:
    """Return the Cargo.toml of a package; Cargo builds the programs in ``src/bin`` by itself.

    Args:
        name: Name of the package.
        version: Version of the package.
        description: Purpose of the package.
        license_name: Its licence.
        library: Name of a library, or None.
    """
    text = _CARGO.format(
        name=name, version=version, description=_toml(description), license=_toml(license_name)
    )
    return f'{text}\n[lib]\nname = "{library}"\n' if library else text


def rust_library(name: str) -> str:
    """Return the source of a library of a package."""
    return _RUST_LIBRARY.format(name=name)


def rust_node(name: str) -> str:
    """Return the source of a program of a package."""
    return _RUST_NODE.format(name=name)


def _class_name(library: str) -> str:
    return "".join(part.capitalize() for part in library.split("_"))


def _toml(text: str) -> str:
    import json

    # A string of JSON is one of TOML, except for pairs of surrogates and the character DEL.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
