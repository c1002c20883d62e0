# source <venv>/setup.fish: for fish, what /opt/ros/jazzy/setup.bash is on a machine with ROS.
set -l root (builtin realpath (dirname (status filename)))
if test "$VIRTUAL_ENV" != $root; and test -f $root/bin/activate.fish
    source $root/bin/activate.fish
end
source $root/local_setup.fish
if status is-interactive; and command -sq register-python-argcomplete
    register-python-argcomplete --shell fish ros2 turtlewire | source # completion by TAB
end
