"""The 3D view under RViz's name, for launch files and users of RViz.

=======  ========
module   contents
=======  ========
`rviz2`  the node
=======  ========
"""
