"""Packages of ament_cmake without CMake: for colcon, and as wheels for pip.

==============================  ==================================================
module                          contents
==============================  ==================================================
`colcon_ament`                  ``colcon build`` and ``test`` of ament_cmake packages
`cmake`                         reads their CMakeLists.txt, without CMake
`package_lookup`                which packages ``find_package`` finds
`plan_install`                  installs what a CMakeLists.txt names
`run_test`                      runs one test of ``colcon test``
`wheel`                         an ament_cmake package as a wheel
`build_backend`, `pip_install`  two ways to install it with pip
==============================  ==================================================
"""
