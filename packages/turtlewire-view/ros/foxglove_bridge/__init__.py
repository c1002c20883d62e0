"""Connects Foxglove and Lichtblick to a robot: the bridge's node, on turtlewire's server.

=================  =========================================
module             contents
=================  =========================================
`foxglove_bridge`  the node and its parameters; the executable
=================  =========================================
"""
