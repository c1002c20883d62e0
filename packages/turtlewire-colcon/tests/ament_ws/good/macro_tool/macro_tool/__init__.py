"""Expands macros: its only macro is $NAME."""

import sys


def expand(text, name):
    return text.replace("$NAME", name)


def main():
    print(expand(*sys.argv[1:3]))
