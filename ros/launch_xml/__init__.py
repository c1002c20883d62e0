"""Launch files in XML."""

from __future__ import annotations

from launch_xml.entity import Entity
from launch_xml.parser import Parser

__all__ = ["Entity", "Parser"]
