# The environment of the prefix this file lies in, without activating its virtual environment.
set -l prefix (builtin realpath (dirname (status filename)))
if not contains -- $prefix (string split -- : "$AMENT_PREFIX_PATH")
    set -gx AMENT_PREFIX_PATH (string join -- : $prefix (string split -n -- : "$AMENT_PREFIX_PATH"))
end
contains -- $prefix/bin $PATH; or set -gx PATH $prefix/bin $PATH
set -q ROS_DISTRO; or set -gx ROS_DISTRO jazzy
set -gx ROS_VERSION 2
set -gx ROS_PYTHON_VERSION 3
# rosdep needs a cache of rules; a user's own one is left alone
set -l ros_home $HOME/.ros
set -q ROS_HOME; and test -n "$ROS_HOME"; and set ros_home $ROS_HOME
if not test -f $ros_home/rosdep/sources.cache/index
    test -n "$ROS_LOG_DIR"; or set -gx ROS_LOG_DIR $ros_home/log
    set -gx ROS_HOME $prefix/share/turtlewire/ros_home
end
# by default rosdep runs pip with sudo, outside of the virtual environment
if test -f $prefix/pyvenv.cfg
    function rosdep --wraps rosdep
        command rosdep --as-root pip:no $argv
    end
end
