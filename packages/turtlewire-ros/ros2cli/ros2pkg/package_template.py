"""The files of a new package."""

from __future__ import annotations

from collections.abc import Sequence
from xml.sax.saxutils import escape, quoteattr

_MANIFEST = """<?xml version="1.0"?>
<?xml-model href="http://download.ros.org/schema/package_format{format}.xsd" schematypens="http://www.w3.org/2001/XMLSchema"?>
<package format="{format}">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>{description}</description>
  <maintainer email={email}>{maintainer}</maintainer>
  <license>{license}</license>

{dependencies}
  <export>
    <build_type>{build_type}</build_type>
  </export>
</package>
"""

_SETUP = """from setuptools import find_packages, setup

package_name = '{name}'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer={maintainer!r},
    maintainer_email={email!r},
    description={description!r},
    license={license!r},
    extras_require={{'test': ['pytest']}},
    entry_points={{
        'console_scripts': [{script}],
    }},
)
"""

_SETUP_CFG = """[develop]
script_dir=$base/lib/{name}
[install]
install_scripts=$base/lib/{name}
"""

_CMAKE = """cmake_minimum_required(VERSION 3.8)
project({name})

find_package(ament_cmake REQUIRED)
{packages}
# Files below msg/, srv/ and action/ become interfaces when these lines name them. package.xml needs
#   <buildtool_depend>rosidl_default_generators</buildtool_depend>
#   <exec_depend>rosidl_default_runtime</exec_depend>
#   <member_of_group>rosidl_interface_packages</member_of_group>
#
# find_package(rosidl_default_generators REQUIRED)
# rosidl_generate_interfaces(${{PROJECT_NAME}}
#   "msg/Name.msg"
#   DEPENDENCIES {dependencies}
# )

# install(DIRECTORY launch DESTINATION share/${{PROJECT_NAME}})

ament_package()
"""

_NODE = """def main():
    print('Hi from {name}.')


if __name__ == '__main__':
    main()
"""


def python_files(
    *,
    name: str,
    package_format: str,
    description: str,
    license_name: str,
    maintainer: tuple[str, str],
    dependencies: Sequence[str],
    node_name: str | None,
) -> dict[str, str]:
    """Return the files of an ament_python package by path in its folder, in the order of making.

    Args:
        name: Name of the package.
        package_format: Format of the package.xml, ``2`` or ``3``.
        description: Purpose of the package.
        license_name: Its licence.
        maintainer: Name and e-mail address.
        dependencies: Packages that it depends on.
        node_name: Name of an executable to begin with, or None.
    """
    script = f"\n            '{node_name} = {name}.{node_name}:main',\n        "
    tags = [("depend", each) for each in dependencies] + [("test_depend", "python3-pytest")]
    made = {
        "package.xml": manifest(
            "ament_python", name, package_format, description, license_name, maintainer, tags
        ),
        f"{name}/__init__.py": "",
        "setup.py": _SETUP.format(
            name=name,
            maintainer=maintainer[0],
            email=maintainer[1],
            description=description,
            license=license_name,
            script="" if node_name is None else script,
        ),
        "setup.cfg": _SETUP_CFG.format(name=name),
        f"resource/{name}": "",
        "test/test_import.py": f"import {name}\n\n\ndef test_the_package_can_be_imported():\n"
        f"    assert {name}.__name__ == '{name}'\n",
    }
    if node_name is not None:
        made[f"{name}/{node_name}.py"] = node(name)
    return made


def node(name: str) -> str:
    """Return the module of a node of a package."""
    return _NODE.format(name=name)


def cmake_files(
    *,
    name: str,
    package_format: str,
    description: str,
    license_name: str,
    maintainer: tuple[str, str],
    dependencies: Sequence[str],
) -> dict[str, str]:
    """Return the files of an ament_cmake package of interfaces or data, like `python_files`."""
    tags = [("buildtool_depend", "ament_cmake"), *(("depend", each) for each in dependencies)]
    return {
        "package.xml": manifest(
            "ament_cmake", name, package_format, description, license_name, maintainer, tags
        ),
        "CMakeLists.txt": _CMAKE.format(
            name=name,
            packages="".join(f"find_package({each} REQUIRED)\n" for each in dependencies),
            dependencies=" ".join(dependencies) or "std_msgs",
        ),
    }


def manifest(
    build_type: str,
    name: str,
    package_format: str,
    description: str,
    license_name: str,
    maintainer: tuple[str, str],
    tags: Sequence[tuple[str, str]],
) -> str:
    """Return a package.xml; `python_files` describes the arguments.

    Args:
        build_type: For example ``ament_python``.
        name: Name of the package.
        package_format: Format of the file.
        description: Purpose of the package.
        license_name: Its licence.
        maintainer: Name and e-mail address.
        tags: The dependencies, each with the name of its element.
    """
    return _MANIFEST.format(
        build_type=build_type,
        format=package_format,
        name=name,
        description=escape(description),
        email=quoteattr(maintainer[1]),
        maintainer=escape(maintainer[0]),
        license=escape(license_name),
        dependencies="".join(f"  <{tag}>{escape(text)}</{tag}>\n" for tag, text in tags),
    )
