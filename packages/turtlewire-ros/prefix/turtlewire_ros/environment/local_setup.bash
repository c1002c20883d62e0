# The environment of the prefix this file lies in, without activating its virtual environment.
TURTLEWIRE_PREFIX="$(builtin cd "$(dirname "${BASH_SOURCE[0]}")" > /dev/null && pwd)"
. "$TURTLEWIRE_PREFIX/local_setup.sh"
unset TURTLEWIRE_PREFIX
