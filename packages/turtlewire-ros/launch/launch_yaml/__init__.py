"""Launch files in YAML.

============================  ====================
module                        contents
============================  ====================
`parser`                      reads the text
`entity`                      one mapping
`launch_description_sources`  launch files by path
============================  ====================
"""

from launch_yaml.entity import Entity
from launch_yaml.parser import Parser

__all__ = ["Entity", "Parser"]
