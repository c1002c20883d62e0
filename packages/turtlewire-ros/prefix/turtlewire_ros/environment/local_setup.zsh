# The environment of the prefix this file lies in, without activating its virtual environment.
TURTLEWIRE_PREFIX="${0:A:h}"
. "$TURTLEWIRE_PREFIX/local_setup.sh"
unset TURTLEWIRE_PREFIX
