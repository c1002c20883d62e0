#!/usr/bin/env python3
from updater import status

print(status("motor").name)
