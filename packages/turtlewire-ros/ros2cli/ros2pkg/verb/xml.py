"""``ros2 pkg xml``."""

from __future__ import annotations

import argparse
import os

from ros2cli.arguments import argument
from ros2cli.completion import packages
from ros2pkg.verb import VerbExtension

PACKAGE_NOT_FOUND = "Package not found"
PACKAGE_XML_NOT_FOUND = "Package XML manifest not found"
PACKAGE_XML_TAG_NOT_FOUND = "XML tag not found"

ARGUMENTS = (
    argument("package_name", help="Name of the package", completer=packages),
    argument("-t", "--tag", help="Show only the content of this tag, for example version"),
)


def main(args: argparse.Namespace) -> str | None:
    """Print the file, or the content of a tag."""
    from ros2cli.suggestion import package_meant
    from turtlewire_ros.prefix import share_directory

    share = share_directory(args.package_name)
    if share is None:
        return f"{PACKAGE_NOT_FOUND}{package_meant(args.package_name)}"
    path = os.path.join(share, "package.xml")
    try:
        with open(path, encoding="utf-8") as file:
            text = file.read()
    except FileNotFoundError:
        return PACKAGE_XML_NOT_FOUND
    if args.tag is None:
        print(text)
        return None
    from defusedxml import ElementTree

    from turtlewire_ros.manifest import manifest_fault

    fault = manifest_fault(path)
    if fault is not None:
        return fault
    elements = ElementTree.fromstring(text, forbid_dtd=True).findall(f".//{args.tag}")
    if not elements:
        return f"No element '{args.tag}' in the package manifest found"
    for element in elements:
        print("".join(element.itertext()))
    return None


class XmlVerb(VerbExtension, module=__name__):
    """Show the package.xml of a package."""
