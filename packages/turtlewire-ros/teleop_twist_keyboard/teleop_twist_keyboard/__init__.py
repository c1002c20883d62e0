"""Drives a robot from a terminal: keys are velocity commands on ``cmd_vel``.

========  ================================
module    contents
========  ================================
`teleop`  keys to velocities, and the node
========  ================================
"""
