"""Launch files in XML.

============================  ====================
module                        contents
============================  ====================
`parser`                      reads the text
`entity`                      one XML element
`launch_description_sources`  launch files by path
============================  ====================
"""

from launch_xml.entity import Entity
from launch_xml.parser import Parser

__all__ = ["Entity", "Parser"]
