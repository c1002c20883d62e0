"""Content filters: which messages a subscription asks its middleware to leave out.

Cyclone DDS filters nothing, neither in ROS 2 (``rmw_cyclonedds_cpp``) nor here: ``is_cft_enabled``
of a subscription is False, and all messages arrive.
"""

from __future__ import annotations

from typing import NamedTuple


class ContentFilterOptions(NamedTuple):
    """A filter of the messages that a subscription receives.

    A condition in SQL, such as ``data < %0``, and the values of its placeholders.
    """

    filter_expression: str
    expression_parameters: list[str]
