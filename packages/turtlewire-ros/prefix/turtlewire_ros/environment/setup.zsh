# source <venv>/setup.zsh: what `source /opt/ros/jazzy/setup.zsh` is on a machine with ROS.
_turtlewire_root="${0:A:h}"
if [ "${VIRTUAL_ENV:-}" != "$_turtlewire_root" ] && [ -f "$_turtlewire_root/bin/activate" ]; then
    . "$_turtlewire_root/bin/activate"
fi
. "$_turtlewire_root/local_setup.zsh"
unset _turtlewire_root
if [[ -o interactive ]] && command -v register-python-argcomplete > /dev/null; then
    (( $+functions[compdef] )) || { autoload -U compinit && compinit -u }
    eval "$(register-python-argcomplete --no-defaults ros2 turtlewire)" # completion by TAB
fi
