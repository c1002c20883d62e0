# For the scripts that do not read their arguments in Python; they source it first:
#
#     usage='[--fix]' . "$(dirname "$0")/usage.sh"
#
# Prints the comment at the top of the script for -h or --help, and refuses words that the usage
# does not have. With a placeholder in capitals in the usage, another program reads the words.
# shellcheck shell=bash disable=SC2154 # usage is set by the script
usage="scripts/${0##*/} [-h]${usage:+ $usage}"
for word in "$@"; do
    if [ "$word" = -h ] || [ "$word" = --help ]; then
        # On a full disk, cat says so in one line; bash 5.3 does in two.
        cat <<<"usage: $usage"$'\n\n'"$(sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$0")" || exit 1
        exit
    fi
done
if [[ ! $usage =~ [A-Z] ]]; then
    for word in "$@"; do
        if [[ " ${usage//[\[\]]/} " != *" $word "* ]]; then
            echo "scripts/${0##*/}: there is no '$word'; usage: $usage" >&2
            exit 2
        fi
    done
fi
