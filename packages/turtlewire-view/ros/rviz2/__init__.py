"""The 3D view under RViz's name, for launch files and habits.

=======  ========
module   what it holds
=======  ========
`rviz2`  the node
=======  ========
"""
