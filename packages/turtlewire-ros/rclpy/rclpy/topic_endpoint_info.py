"""The ends of topics, under Jazzy's and Kilted's names.

In Lyrical, they are in :mod:`rclpy.endpoint_info`.
"""

from turtlewire.distro import LYRICAL, since

from .endpoint_info import EndpointTypeEnum as TopicEndpointTypeEnum
from .endpoint_info import TopicEndpointInfo

__all__ = ["TopicEndpointInfo", "TopicEndpointTypeEnum"]

if since(LYRICAL):
    raise ModuleNotFoundError(f"No module named '{__name__}'", name=__name__)
