"""Stands in for RViz in launch files: turtlewire has no 3D view yet.

=======  ========
module   what it holds
=======  ========
`rviz2`  the node
=======  ========
"""
