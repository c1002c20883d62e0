"""The class of ``ros2 pkg xml``."""

from __future__ import annotations

from ros2cli.builtin import BuiltinVerb
from ros2pkg.verb import VerbExtension

__all__ = ["PACKAGE_NOT_FOUND", "PACKAGE_XML_NOT_FOUND", "PACKAGE_XML_TAG_NOT_FOUND", "XmlVerb"]

PACKAGE_NOT_FOUND = "Package not found"
PACKAGE_XML_NOT_FOUND = "Package XML manifest not found"
PACKAGE_XML_TAG_NOT_FOUND = "XML tag not found"


class XmlVerb(BuiltinVerb, VerbExtension):
    """Show the package.xml of a package."""

    _module = "pkg.xml"
