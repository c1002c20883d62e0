"""The prefix of this distribution's ROS packages: where they are, and what can be run.

====================================  ====================================================
module                                what it holds
====================================  ====================================================
`prefix`                              finds packages: colcon workspaces, this prefix, pip
`executables`                         what ``ros2 run PACKAGE EXECUTABLE`` runs
`guard`                               starts ``ros2``, and refuses a mix with a real ROS 2
`process_family`, `process_guardian`  stop all that a command started
`colcon_interfaces`                   builds interface and data packages of a workspace
`cmake_data`                          what a CMakeLists.txt without code installs
`manifest`                            the error in a ``package.xml``
====================================  ====================================================
"""
