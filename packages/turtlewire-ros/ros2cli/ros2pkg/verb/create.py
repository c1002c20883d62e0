"""``ros2 pkg create``."""

from __future__ import annotations

import argparse
import os
import re

from ros2cli.arguments import argument
from ros2cli.completion import files
from ros2pkg import package_template
from ros2pkg.verb import VerbExtension

_NAME = re.compile(r"[a-z](?:[a-z0-9]|_(?!_))*")
_NODE_NAME = re.compile(r"[A-Za-z_]\w*", re.ASCII)


ARGUMENTS = (
    argument("package_name", help="Name of the package: small letters, digits and underscores"),
    argument(
        "--package-format",
        "--package_format",
        choices=["2", "3"],
        default="3",
        help="Format of the package.xml",
    ),
    argument("--description", default="TODO: Package description", help="Purpose of the package"),
    argument(
        "--license", default="TODO: License declaration", help="Its licence, for example Apache-2.0"
    ),
    argument(
        "--destination-directory",
        default=os.curdir,
        help="Folder in which the package's folder is made",
        completer=files,
    ),
    argument(
        "--build-type",
        default="ament_python",
        choices=["ament_cmake", "ament_python"],
        help="ament_cmake for interfaces and data; C++ programs need a real ROS",
    ),
    argument("--dependencies", nargs="+", default=[], help="Packages that it depends on"),
    argument("--maintainer-email", help="Address of the maintainer"),
    argument(
        "--maintainer-name",
        default=os.environ.get("USER") or "maintainer",
        help="Name of the maintainer",
    ),
    argument("--node-name", help="Make a node of this name"),
)


def main(args: argparse.Namespace) -> str | None:
    """Make the folder with all that a package needs."""
    if not _NAME.fullmatch(args.package_name):
        return (
            f"Invalid package name '{args.package_name}': use lower-case letters, digits and"
            " single underscores, and begin with a letter"
        )
    if args.node_name is not None and not _NODE_NAME.fullmatch(args.node_name):
        return (
            f"Invalid node name '{args.node_name}': use letters, digits and underscores, and do"
            " not begin with a digit"
        )
    if args.node_name is not None and args.build_type == "ament_cmake":
        return (
            "Nodes of ament_cmake packages are C++ programs, which need a real ROS: use"
            " --build-type ament_python"
        )
    if args.node_name == args.package_name:
        return "[ERROR] [ros2pkg]: node name cannot be the same as the package name"
    folder = os.path.join(args.destination_directory, args.package_name)
    if os.path.exists(folder):
        return (
            f"\nAborted!\nThe directory already exists: {folder}\n"
            "Remove it, or choose another destination directory or package name"
        )
    # As ROS 2 fills it in.
    email = args.maintainer_email or f"{args.maintainer_name}@todo.todo"
    _print_plan(args, email)
    _write(folder, _files(args, email))
    return None


def _files(args: argparse.Namespace, email: str) -> dict[str, str]:
    known = {
        "name": args.package_name,
        "package_format": args.package_format,
        "description": args.description,
        "license_name": args.license,
        "maintainer": (args.maintainer_name, email),
        "dependencies": args.dependencies,
    }
    if args.build_type == "ament_cmake":
        return package_template.cmake_files(**known)
    return package_template.python_files(**known, node_name=args.node_name)


def _print_plan(args: argparse.Namespace, email: str) -> None:
    print("going to create a new package")
    print(f"package name: {args.package_name}")
    print(f"destination directory: {os.path.abspath(args.destination_directory)}")
    print(f"package format: {args.package_format}")
    print("version: 0.0.0")
    print(f"description: {args.description}")
    print(f"maintainer: ['{args.maintainer_name} <{email}>']")
    print(f"licenses: ['{args.license}']")
    print(f"build type: {args.build_type}")
    print(f"dependencies: {args.dependencies}")
    if args.node_name is not None:
        print(f"node_name: {args.node_name}")


def _write(folder: str, files: dict[str, str]) -> None:
    made: set[str] = set()
    for path, text in files.items():
        parent = os.path.dirname(path)
        for part in (folder, *((os.path.join(folder, parent),) if parent else ())):
            if part not in made:
                print(f"creating folder {part}")
                os.makedirs(part, exist_ok=True)
                made.add(part)
        target = os.path.join(folder, path)
        print(f"creating {target}")
        with open(target, "w", encoding="utf-8") as file:
            file.write(text)


class CreateVerb(VerbExtension, module=__name__):
    """Create a package."""
