"""The drawing of each type of message: pure functions, without network, buffer and threads.

=================  =============================================================================
module             contents
=================  =============================================================================
`content`          `Display` and the results that it computes from messages
`options`          the options of displays, and the user's choices
`numeric`          poses, points and colours of messages as arrays
`poses`            PoseStamped, PoseWithCovarianceStamped, PoseArray, Odometry, Path
`shapes`           PolygonStamped, PointStamped, GridCells, Range, CameraInfo; Temperature,
                   RelativeHumidity, FluidPressure, Illuminance; TwistStamped, AccelStamped,
                   WrenchStamped
`points`           the common base of point clouds and scans; colours from values
`point_cloud`      PointCloud2 and PointCloud
`laser_scan`       LaserScan
`occupancy_grid`   OccupancyGrid and OccupancyGridUpdate
`marker`           Marker and MarkerArray
`marker_shapes`    one marker, and the image on its triangles
`interactive_markers`  InteractiveMarkerUpdate; a marker, its controls and menu
`image`            Image and CompressedImage; pixels as RGBA
`camera`           images with the scene drawn over them; the intrinsics of a CameraInfo
`depth_cloud`      depth images as points, with colours of another image
`robot_model`      the links of a URDF; their mass and inertia as bodies
`effort`           the efforts of a JointState at the joints of a URDF
=================  =============================================================================
"""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from turtlewire_view.displays.content import Display

__all__ = ["display_for", "display_types", "displays_of", "further_kinds"]


def display_types() -> dict[str, type[Display]]:
    """Return the display of each message type."""
    from turtlewire_view.displays.effort import EffortDisplay
    from turtlewire_view.displays.image import CompressedImageDisplay, ImageDisplay
    from turtlewire_view.displays.interactive_markers import InteractiveMarkersDisplay
    from turtlewire_view.displays.laser_scan import LaserScanDisplay
    from turtlewire_view.displays.marker import MarkerDisplay
    from turtlewire_view.displays.occupancy_grid import OccupancyGridDisplay
    from turtlewire_view.displays.point_cloud import OldPointCloudDisplay, PointCloudDisplay
    from turtlewire_view.displays.poses import (
        OdometryDisplay,
        PathDisplay,
        PoseArrayDisplay,
        PoseDisplay,
    )
    from turtlewire_view.displays.robot_model import RobotModelDisplay
    from turtlewire_view.displays.shapes import (
        CameraInfoDisplay,
        GridCellsDisplay,
        MeasurementDisplay,
        PointDisplay,
        PolygonDisplay,
        RangeDisplay,
        TwistOrWrenchDisplay,
    )

    return {
        "geometry_msgs/msg/AccelStamped": TwistOrWrenchDisplay,
        "geometry_msgs/msg/PointStamped": PointDisplay,
        "geometry_msgs/msg/PolygonStamped": PolygonDisplay,
        "geometry_msgs/msg/PoseArray": PoseArrayDisplay,
        "geometry_msgs/msg/PoseStamped": PoseDisplay,
        "geometry_msgs/msg/PoseWithCovarianceStamped": PoseDisplay,
        "geometry_msgs/msg/TwistStamped": TwistOrWrenchDisplay,
        "geometry_msgs/msg/WrenchStamped": TwistOrWrenchDisplay,
        "nav_msgs/msg/GridCells": GridCellsDisplay,
        "nav_msgs/msg/OccupancyGrid": OccupancyGridDisplay,
        "nav_msgs/msg/Odometry": OdometryDisplay,
        "nav_msgs/msg/Path": PathDisplay,
        "sensor_msgs/msg/CameraInfo": CameraInfoDisplay,
        "sensor_msgs/msg/CompressedImage": CompressedImageDisplay,
        "sensor_msgs/msg/FluidPressure": MeasurementDisplay,
        "sensor_msgs/msg/Illuminance": MeasurementDisplay,
        "sensor_msgs/msg/Image": ImageDisplay,
        "sensor_msgs/msg/JointState": EffortDisplay,
        "sensor_msgs/msg/LaserScan": LaserScanDisplay,
        "sensor_msgs/msg/PointCloud": OldPointCloudDisplay,
        "sensor_msgs/msg/PointCloud2": PointCloudDisplay,
        "sensor_msgs/msg/Range": RangeDisplay,
        "sensor_msgs/msg/RelativeHumidity": MeasurementDisplay,
        "sensor_msgs/msg/Temperature": MeasurementDisplay,
        "std_msgs/msg/String": RobotModelDisplay,
        "visualization_msgs/msg/InteractiveMarkerUpdate": InteractiveMarkersDisplay,
        "visualization_msgs/msg/Marker": MarkerDisplay,
        "visualization_msgs/msg/MarkerArray": MarkerDisplay,
    }


def displays_of(kind: str) -> dict[str, type[Display]]:
    """Return the displays of a kind by message type."""
    all_types = [display_types(), *_further_types().values()]
    return {name: each for types in all_types for name, each in types.items() if each.kind == kind}


def further_kinds(topic: str, type_name: str, names: Collection[str]) -> list[str]:
    """Return the kinds of displays that a user may choose for a topic instead of the usual one.

    Args:
        topic: Name of the topic.
        type_name: Its message type.
        names: All topics, because some displays need several.
    """
    return [
        kind
        for kind, types in _further_types().items()
        if type_name in types and types[type_name].suits(topic, names)
    ]


def _further_types() -> dict[str, dict[str, type[Display]]]:
    """Return the displays by kind and message type that are not the usual one of the type."""
    from turtlewire_view.displays.camera import CameraDisplay, CompressedCameraDisplay
    from turtlewire_view.displays.depth_cloud import DepthCloudDisplay

    return {
        "camera": {
            "sensor_msgs/msg/CompressedImage": CompressedCameraDisplay,
            "sensor_msgs/msg/Image": CameraDisplay,
        },
        "depth_cloud": {"sensor_msgs/msg/Image": DepthCloudDisplay},
    }


def display_for(topic: str, type_name: str) -> type[Display] | None:
    """The display that a topic is offered for; of Strings only those that describe robots."""
    if type_name == "std_msgs/msg/String" and not topic.endswith("robot_description"):
        return None
    return display_types().get(type_name)
