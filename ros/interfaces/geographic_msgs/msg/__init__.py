"""The msg interfaces of geographic_msgs: classes made at first access."""

from turtlewire.msg import lazy_classes

__all__ = [
    "BoundingBox",
    "GeoPath",
    "GeoPoint",
    "GeoPointStamped",
    "GeoPose",
    "GeoPoseStamped",
    "GeoPoseWithCovariance",
    "GeoPoseWithCovarianceStamped",
    "GeographicMap",
    "GeographicMapChanges",
    "KeyValue",
    "MapFeature",
    "RouteNetwork",
    "RoutePath",
    "RouteSegment",
    "WayPoint",
]

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
