# For the scripts whose options Python reads; they source it first. The help, or a wrong word, ends
# the script before the set-up, which then says what is wrong with this Python.
# shellcheck shell=bash
options=("${PYTHON:-python3}" "$(dirname "$0")/../tools/early_options.py" "${0##*/}")
for word in "$@"; do
    case $word in -h | --help) exec "${options[@]}" --help ;; esac
done
if [ $# -gt 0 ] && command -v "${options[0]}" >/dev/null; then
    "${options[@]}" "$@" || exit
fi
unset options
