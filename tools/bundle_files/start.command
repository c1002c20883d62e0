#!/bin/sh
# Installs turtlewire from this folder, without a network, and runs the demo.
cd "$(dirname "$0")" || exit 1
exec "${PYTHON:-python3}" start.py "$@"
