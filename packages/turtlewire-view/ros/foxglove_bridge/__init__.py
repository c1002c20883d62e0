"""Foxglove and Lichtblick see a robot: the bridge's node, on turtlewire's Foxglove server.

=================  =========================================
module             what it holds
=================  =========================================
`foxglove_bridge`  the node and its parameters; the executable
=================  =========================================
"""
