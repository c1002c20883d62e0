"""Between structured arrays and plain ones; in ROS 2 for old versions of NumPy."""

from numpy.lib.recfunctions import structured_to_unstructured, unstructured_to_structured

__all__ = ["structured_to_unstructured", "unstructured_to_structured"]
