"""Helpers for sensor messages in Python, as ROS 2's package of this name.

==============  ==================================
module          contents
==============  ==================================
`point_cloud2`  point clouds as arrays, and back
`numpy_compat`  structured arrays as plain ones
==============  ==================================
"""
