"""The files of a new ament_python package."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.sax.saxutils import escape, quoteattr

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["files"]

_MANIFEST = """<?xml version="1.0"?>
<?xml-model href="http://download.ros.org/schema/package_format{format}.xsd" schematypens="http://www.w3.org/2001/XMLSchema"?>
<package format="{format}">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>{description}</description>
  <maintainer email={email}>{maintainer}</maintainer>
  <license>{license}</license>

{dependencies}  <test_depend>python3-pytest</test_depend>

  <export>
    <build_type>ament_python</build_type>
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

_NODE = """def main():
    print('Hi from {name}.')


if __name__ == '__main__':
    main()
"""


def files(
    *,
    name: str,
    package_format: str,
    description: str,
    license_name: str,
    maintainer: tuple[str, str],
    dependencies: Iterable[str],
    node_name: str | None,
) -> dict[str, str]:
    """Contents by path within the package's folder, in the order in which they are made.

    Args:
        name: Name of the package.
        package_format: Format of the package.xml, ``2`` or ``3``.
        description: Purpose of the package.
        license_name: Its licence.
        maintainer: Name and e-mail address.
        dependencies: Packages that it depends on.
        node_name: Name of an executable to begin with, or None.
    """
    depends = "".join(f"  <depend>{escape(dependency)}</depend>\n" for dependency in dependencies)
    script = f"\n            '{node_name} = {name}.{node_name}:main',\n        "
    made = {
        "package.xml": _MANIFEST.format(
            format=package_format,
            name=name,
            description=escape(description),
            email=quoteattr(maintainer[1]),
            maintainer=escape(maintainer[0]),
            license=escape(license_name),
            dependencies=f"{depends}\n" if depends else "",
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
        made[f"{name}/{node_name}.py"] = _NODE.format(name=name)
    return made
