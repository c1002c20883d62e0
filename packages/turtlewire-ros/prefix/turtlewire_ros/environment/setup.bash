# source <venv>/setup.bash: what `source /opt/ros/jazzy/setup.bash` is on a machine with ROS.
if [ -z "${BASH_VERSION:-}" ]; then
    echo "turtlewire: setup.bash is for bash: type bash, then the same again (there are" \
        "setup.zsh and setup.fish, too)" >&2
    return 1
fi
_turtlewire_root="$(builtin cd "$(dirname "${BASH_SOURCE[0]}")" > /dev/null && pwd)"
if [ "${VIRTUAL_ENV:-}" != "$_turtlewire_root" ] && [ -f "$_turtlewire_root/bin/activate" ]; then
    . "$_turtlewire_root/bin/activate"
fi
. "$_turtlewire_root/local_setup.bash"
case "$_turtlewire_root" in
*\ *)
    echo "turtlewire: there is a space in $_turtlewire_root; the install/*setup.bash that colcon" \
        "makes with it will not work" >&2
    ;;
esac
unset _turtlewire_root
if [ -n "${PS1:-}" ] && command -v register-python-argcomplete > /dev/null; then
    # Completion by TAB, in interactive shells.
    eval "$(register-python-argcomplete --no-defaults ros2 turtlewire)"
fi
