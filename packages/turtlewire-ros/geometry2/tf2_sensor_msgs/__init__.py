"""Point clouds in another frame, as ROS 2's package of this name; normals are turned along.

Importing it makes ``tf2_ros.Buffer.transform`` take ``sensor_msgs.msg.PointCloud2``.

=================  ===========================
module             contents
=================  ===========================
`clouds`           transforms of point clouds
`tf2_sensor_msgs`  ROS 2's module of this name
=================  ===========================
"""

import tf2_ros
from sensor_msgs.msg import PointCloud2
from tf2_geometry_msgs import from_msg_msg, to_msg_msg
from tf2_sensor_msgs.clouds import do_transform_cloud, transform_points

__all__ = ["do_transform_cloud", "from_msg_msg", "to_msg_msg", "transform_points"]

tf2_ros.TransformRegistration().add(PointCloud2, do_transform_cloud)
tf2_ros.ConvertRegistration().add_to_msg(PointCloud2, to_msg_msg)
tf2_ros.ConvertRegistration().add_from_msg(PointCloud2, from_msg_msg)
