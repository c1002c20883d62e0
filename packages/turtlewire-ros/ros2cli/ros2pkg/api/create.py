"""Steps by which programs make packages: a package's object describes what is made.

The object is a ``catkin_pkg.package.Package``, or has its attributes ``name``, ``version``,
``package_format``, ``description``, ``maintainers``, ``licenses``, ``buildtool_depends``,
``build_depends`` and ``test_depends``, and its method ``get_build_type``.
"""

from __future__ import annotations

import os
from typing import Any

from ros2pkg import compiled_template, package_template

#: The folders of the sources by the type of the build; other types get none.
_SOURCES = {"ament_python": "{name}", "ament_cmake": "src", "cmake": "src", "ament_cargo": "src"}


def create_package_environment(
    package: Any, destination_directory: str
) -> tuple[str, str | None, str | None]:
    """Make the folders of a package, and its package.xml.

    Args:
        package: What the package is.
        destination_directory: Folder in which the folder of the package is made.

    Returns:
        The folder of the package, the folder of its sources, and the folder of its headers; the
        latter two are None if a package of this type has none.
    """
    folder = _folder(destination_directory, package.name)
    build_type = package.get_build_type()
    _write(
        folder,
        "package.xml",
        package_template.manifest(
            build_type,
            package.name,
            str(package.package_format),
            package.description,
            ", ".join(map(str, package.licenses)),
            (package.maintainers[0].name, package.maintainers[0].email),
            _tags(package),
        ),
    )
    sources = headers = None
    if build_type in _SOURCES:
        sources = _folder(folder, _SOURCES[build_type].format(name=package.name))
    if build_type in ("ament_cmake", "cmake"):
        headers = _folder(folder, os.path.join("include", package.name))
    return folder, sources, headers


def populate_ament_python(
    package: Any, package_directory: str, source_directory: str, python_node_name: str | None
) -> None:
    """Write the files of an ament_python package, but for its nodes and its package.xml.

    Args:
        package: What the package is.
        package_directory: Folder of the package.
        source_directory: Folder of its modules.
        python_node_name: Name of an executable that setup.py declares, or None.
    """
    maintainer = package.maintainers[0]
    files = package_template.python_files(
        name=package.name,
        package_format=str(package.package_format),
        description=package.description,
        license_name=", ".join(map(str, package.licenses)),
        maintainer=(maintainer.name, maintainer.email),
        dependencies=(),
        node_name=python_node_name,
    )
    for path, text in files.items():
        folder, name = os.path.split(path)
        if folder == package.name:
            if name == "__init__.py":
                _write(source_directory, name, text)
        elif path != "package.xml":
            _write(os.path.join(package_directory, folder), name, text)


def populate_python_node(package: Any, source_directory: str, python_node_name: str) -> None:
    """Write the module of a node."""
    _write(source_directory, f"{python_node_name}.py", package_template.node(package.name))


def populate_python_libary(package: Any, source_directory: str, python_library_name: str) -> None:
    """Make a package of Python within the modules of a package."""
    del package
    _write(_folder(source_directory, python_library_name), "__init__.py", "")


def populate_cpp_node(package: Any, source_directory: str, cpp_node_name: str) -> None:
    """Write the source of a program in C++."""
    text = compiled_template.cpp_node(package.name)
    _write(source_directory, f"{cpp_node_name}.cpp", text)


def populate_cpp_library(
    package: Any, source_directory: str, include_directory: str, cpp_library_name: str
) -> None:
    """Write the source and the header of a library in C++."""
    header = compiled_template.cpp_header(package.name, cpp_library_name)
    _write(include_directory, f"{cpp_library_name}.hpp", header)
    source = compiled_template.cpp_source(package.name, cpp_library_name)
    _write(source_directory, f"{cpp_library_name}.cpp", source)


def populate_cmake(
    package: Any,
    package_directory: str,
    cpp_node_name: str | None,
    cpp_library_name: str | None,
) -> None:
    """Write the CMakeLists.txt of a package that CMake builds alone.

    Args:
        package: What the package is.
        package_directory: Folder of the package.
        cpp_node_name: Name of an executable, or None.
        cpp_library_name: Name of a library, or None.
    """
    names = _names(package.build_depends)
    text = compiled_template.cmake_lists(package.name, names, cpp_node_name, cpp_library_name)
    _write(package_directory, "CMakeLists.txt", text)


def populate_ament_cmake(
    package: Any,
    package_directory: str,
    cpp_node_name: str | None,
    cpp_library_name: str | None,
) -> None:
    """Write the CMakeLists.txt of an ament_cmake package, like `populate_cmake`."""
    names = _names(package.build_depends)
    text = compiled_template.ament_cmake_lists(package.name, names, cpp_node_name, cpp_library_name)
    _write(package_directory, "CMakeLists.txt", text)


def populate_ament_cargo(
    package: Any, package_directory: str, cargo_library_name: str | None
) -> None:
    """Write the Cargo.toml of a package in Rust, and the source of a library.

    Args:
        package: What the package is.
        package_directory: Folder of the package.
        cargo_library_name: Name of the library, or None.
    """
    licence = " OR ".join(map(str, package.licenses))
    text = compiled_template.cargo_manifest(
        package.name, package.version, package.description, licence, cargo_library_name
    )
    _write(package_directory, "Cargo.toml", text)
    if cargo_library_name:
        sources = os.path.join(package_directory, "src")
        _write(sources, "lib.rs", compiled_template.rust_library(package.name))


def populate_rust_node(package: Any, source_directory: str, node_name: str) -> None:
    """Write the source of a program in Rust, which Cargo finds in ``bin`` by its name."""
    folder = _folder(source_directory, "bin")
    _write(folder, f"{node_name}.rs", compiled_template.rust_node(package.name))


def _tags(package: Any) -> list[tuple[str, str]]:
    kinds = ("buildtool_depend", "build_depend", "test_depend")
    tags = [(kind, name) for kind in kinds for name in _names(getattr(package, f"{kind}s"))]
    # As in ROS 2's packages, what is needed to build is needed to run.
    return [("depend" if tag == "build_depend" else tag, name) for tag, name in tags]


def _names(dependencies: Any) -> list[str]:
    """Return the names of dependencies, which are objects of catkin_pkg or text."""
    return [getattr(each, "name", each) for each in dependencies]


def _folder(parent: str, name: str) -> str:
    path = os.path.join(parent, name)
    print(f"creating folder {path}")
    os.makedirs(path, exist_ok=True)
    return path


def _write(folder: str, name: str, text: str) -> None:
    path = os.path.join(folder, name)
    print(f"creating {path}")
    os.makedirs(folder, exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
