"""The prefix of this distribution's ROS packages: where they are, and what can be run.

`prefix` finds packages, `executables` what they contain to run, `guard` starts ``ros2``,
`process_family` ends what a command started, `colcon_interfaces` builds interface packages.
"""
