"""ROS 2's minimal examples: An action server for Fibonacci sequences.

========  =============================================================
module    what it holds
========  =============================================================
`server`  feedback once a second, cancellation, several goals at a time
========  =============================================================
"""
