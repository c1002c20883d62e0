"""Launch files, for programs and extensions.

=====  ================================
module contents
=====  ================================
`api`  launch files: found, shown, run
=====  ================================
"""

from launch.frontend.parser import InvalidFrontendLaunchFileError
from launch.invalid_launch_file_error import InvalidLaunchFileError
from launch.launch_description_sources import InvalidPythonLaunchFileError
from ros2launch.api.api import (
    LaunchFileNameCompleter,
    MultipleLaunchFilesError,
    get_share_file_path_from_package,
    is_launch_file,
    launch_a_launch_file,
    print_a_launch_file,
    print_arguments_of_launch_description,
    print_arguments_of_launch_file,
)

__all__ = [
    "InvalidFrontendLaunchFileError",
    "InvalidLaunchFileError",
    "InvalidPythonLaunchFileError",
    "LaunchFileNameCompleter",
    "MultipleLaunchFilesError",
    "get_share_file_path_from_package",
    "is_launch_file",
    "launch_a_launch_file",
    "print_a_launch_file",
    "print_arguments_of_launch_description",
    "print_arguments_of_launch_file",
]
