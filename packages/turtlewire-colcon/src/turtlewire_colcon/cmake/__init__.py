"""Reads the CMakeLists.txt of packages without C++, as CMake and ament would.

Nothing is configured or compiled: the commands are evaluated, and what they would install, generate
and test is collected in a `plan.Plan`.

==============  =======================================================================
module          contents
==============  =======================================================================
`syntax`        commands of a file with their lines, blocks and keywords
`conditions`    the conditions of ``if`` and ``while``
`interpreter`   variables, and the order in which commands run
`basics`        ``set``, ``list``, ``string``, ``message``, ``option`` …
`files`         ``file``, ``configure_file``, ``install``, ``include`` …
`ament`         ``find_package``, ``ament_…``, ``rosidl_generate_interfaces``, ``xacro_add_files``
`targets`       commands that compile C++, and commands without an effect here
`processes`     ``execute_process``, ``add_custom_command``, ``add_custom_target``
`tool`          a replacement of ``cmake -E``
`plan`          what a package installs, generates and tests
`evaluate`      the plan of a package's folder
==============  =======================================================================
"""
