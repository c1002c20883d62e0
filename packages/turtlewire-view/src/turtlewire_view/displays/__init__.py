"""The drawing of each type of message: pure functions, without network, buffer and threads.

=================  =============================================================================
module             contents
=================  =============================================================================
`content`          `Display` and the results that it computes from messages
`options`          the options of displays, and the user's choices
`numeric`          poses, points and colours of messages as arrays
`path`             Path
`poses`            PoseStamped, PoseWithCovarianceStamped, PoseArray, Odometry
`covariance`       the ellipsoid of a covariance
`shapes`           PolygonStamped, PointStamped, GridCells, Range, CameraInfo
`twist_or_wrench`  TwistStamped, AccelStamped, WrenchStamped
`measurement`      Temperature, RelativeHumidity, FluidPressure, Illuminance
`points`           the common base of point clouds and scans
`point_cloud`      PointCloud2 and PointCloud
`cloud_layout`     the bytes of a point cloud as records
`coloring`         colours from values
`laser_scan`       LaserScan
`occupancy_grid`   OccupancyGrid and OccupancyGridUpdate
`marker`           Marker and MarkerArray
`marker_shapes`    one marker
`marker_texture`   the image on the triangles of a marker
`image`            Image and CompressedImage
`encodings`        pixels as RGBA
`robot_model`      the links of a URDF
=================  =============================================================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from turtlewire_view.displays.content import Display

__all__ = ["display_for", "display_types"]


def display_types() -> dict[str, type[Display]]:
    """Return the display of each message type."""
    from turtlewire_view.displays.image import CompressedImageDisplay, ImageDisplay
    from turtlewire_view.displays.laser_scan import LaserScanDisplay
    from turtlewire_view.displays.marker import MarkerDisplay
    from turtlewire_view.displays.measurement import MeasurementDisplay
    from turtlewire_view.displays.occupancy_grid import OccupancyGridDisplay
    from turtlewire_view.displays.path import PathDisplay
    from turtlewire_view.displays.point_cloud import OldPointCloudDisplay, PointCloudDisplay
    from turtlewire_view.displays.poses import OdometryDisplay, PoseArrayDisplay, PoseDisplay
    from turtlewire_view.displays.robot_model import RobotModelDisplay
    from turtlewire_view.displays.shapes import (
        CameraInfoDisplay,
        GridCellsDisplay,
        PointDisplay,
        PolygonDisplay,
        RangeDisplay,
    )
    from turtlewire_view.displays.twist_or_wrench import TwistOrWrenchDisplay

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
        "sensor_msgs/msg/LaserScan": LaserScanDisplay,
        "sensor_msgs/msg/PointCloud": OldPointCloudDisplay,
        "sensor_msgs/msg/PointCloud2": PointCloudDisplay,
        "sensor_msgs/msg/Range": RangeDisplay,
        "sensor_msgs/msg/RelativeHumidity": MeasurementDisplay,
        "sensor_msgs/msg/Temperature": MeasurementDisplay,
        "std_msgs/msg/String": RobotModelDisplay,
        "visualization_msgs/msg/Marker": MarkerDisplay,
        "visualization_msgs/msg/MarkerArray": MarkerDisplay,
    }


def display_for(topic: str, type_name: str) -> type[Display] | None:
    """The display that a topic is offered for; of Strings only those that describe robots."""
    if type_name == "std_msgs/msg/String" and not topic.endswith("robot_description"):
        return None
    return display_types().get(type_name)
