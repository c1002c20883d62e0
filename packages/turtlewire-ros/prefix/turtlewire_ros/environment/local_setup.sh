# The environment of this prefix, for shells that do not know the path of a sourced file:
# TURTLEWIRE_PREFIX says so, and the setup.sh of colcon's workspaces does by COLCON_CURRENT_PREFIX.
# shellcheck shell=sh
_turtlewire_prefix="${AMENT_CURRENT_PREFIX:-${TURTLEWIRE_PREFIX:-}}"
_turtlewire_prefix="${_turtlewire_prefix:-${COLCON_CURRENT_PREFIX:-${VIRTUAL_ENV:-}}}"
if [ ! -f "$_turtlewire_prefix/local_setup.sh" ]; then
    echo "turtlewire: set TURTLEWIRE_PREFIX to the folder of local_setup.sh before sourcing it" >&2
else
    case ":${AMENT_PREFIX_PATH:-}:" in
    *":$_turtlewire_prefix:"*) ;;
    *) export AMENT_PREFIX_PATH="$_turtlewire_prefix${AMENT_PREFIX_PATH:+:$AMENT_PREFIX_PATH}" ;;
    esac
    case ":$PATH:" in
    *":$_turtlewire_prefix/bin:"*) ;;
    *) export PATH="$_turtlewire_prefix/bin:$PATH" ;;
    esac
    export ROS_DISTRO="${ROS_DISTRO:-jazzy}" ROS_VERSION=2 ROS_PYTHON_VERSION=3
    # rosdep needs a cache of rules; a user's own one is left alone
    if [ ! -f "${ROS_HOME:-$HOME/.ros}/rosdep/sources.cache/index" ]; then
        : "${ROS_LOG_DIR:=${ROS_HOME:-$HOME/.ros}/log}"
        export ROS_LOG_DIR ROS_HOME="$_turtlewire_prefix/share/turtlewire/ros_home"
    fi
    # by default rosdep runs pip with sudo, outside of the virtual environment
    if [ -f "$_turtlewire_prefix/pyvenv.cfg" ]; then
        rosdep() { command rosdep --as-root pip:no "$@"; }
    fi
fi
unset _turtlewire_prefix
