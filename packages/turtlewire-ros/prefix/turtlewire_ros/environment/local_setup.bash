# The environment of the prefix this file lies in, without activating its virtual environment.
if [ -z "${BASH_VERSION:-}" ]; then
    echo "turtlewire: local_setup.bash is for bash: type bash, then the same again" >&2
    return 1
fi
TURTLEWIRE_PREFIX="$(builtin cd "$(dirname "${BASH_SOURCE[0]}")" > /dev/null && pwd)"
. "$TURTLEWIRE_PREFIX/local_setup.sh"
unset TURTLEWIRE_PREFIX
