"""Drives a robot from a terminal: keys are velocity commands on ``cmd_vel``.

========  ================================
module    what it holds
========  ================================
`teleop`  keys to velocities, and the node
========  ================================
"""
