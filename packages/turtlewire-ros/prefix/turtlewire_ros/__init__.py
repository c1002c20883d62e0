"""The prefix of this distribution's ROS packages, and their executables.

====================================  ====================================================
module                                contents
====================================  ====================================================
`prefix`                              finds packages: colcon workspaces, this prefix, pip
`workspace_hints`                     hints about packages of a workspace that are not found
`rqt`                                 names the replacements of rqt's programs
`executables`                         what ``ros2 run PACKAGE EXECUTABLE`` runs
`guard`                               starts ``ros2``, and refuses a mix with a real ROS 2
`process_family`, `process_guardian`  stop all processes that a command started
`interface_files`                     definitions and IDL of the prefix's own packages
`generate_interfaces`                 generates the Python modules of interfaces
`manifest`                            reads ``package.xml``, and finds the error in it
`pytest_plugin`, `pytest_hookspecs`   options, markers and hook of launch tests
====================================  ====================================================
"""
