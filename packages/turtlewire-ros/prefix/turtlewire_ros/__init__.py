"""The prefix of this distribution's ROS packages: where they are, and what can be run.

====================================  ====================================================
module                                what it holds
====================================  ====================================================
`prefix`                              finds packages: colcon workspaces, this prefix, pip
`workspace_hints`                     says what a colcon workspace has, and is not found
`rqt`                                 answers with what shows the same as a program of rqt
`executables`                         what ``ros2 run PACKAGE EXECUTABLE`` runs
`guard`                               starts ``ros2``, and refuses a mix with a real ROS 2
`process_family`, `process_guardian`  stop all that a command started
`interface_files`                     definitions and IDL of the prefix's own packages
`generate_interfaces`                 Python of interfaces, all of whose types must be there
`manifest`                            reads ``package.xml``, and finds the error in it
`pytest_plugin`, `pytest_hookspecs`   options, markers and hook of launch tests
====================================  ====================================================
"""
