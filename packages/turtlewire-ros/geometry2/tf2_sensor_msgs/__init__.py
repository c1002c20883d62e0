"""Point clouds in another frame, as ROS 2's package of this name; normals are turned along.

Importing it makes ``tf2_ros.Buffer.transform`` take ``sensor_msgs.msg.PointCloud2``.

=================  ==========================
module             contents
=================  ==========================
`tf2_sensor_msgs`  transforms of point clouds
=================  ==========================
"""

import tf2_ros
from sensor_msgs.msg import PointCloud2
from tf2_sensor_msgs.tf2_sensor_msgs import (
    do_transform_cloud,
    from_msg_msg,
    to_msg_msg,
    transform_points,
)

__all__ = ["do_transform_cloud", "from_msg_msg", "to_msg_msg", "transform_points"]

tf2_ros.TransformRegistration().add(PointCloud2, do_transform_cloud)
tf2_ros.ConvertRegistration().add_to_msg(PointCloud2, to_msg_msg)
tf2_ros.ConvertRegistration().add_from_msg(PointCloud2, from_msg_msg)
