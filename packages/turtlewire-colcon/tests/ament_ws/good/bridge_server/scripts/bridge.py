#!/usr/bin/env python3
import sys

from bridge_server.capabilities.topics import topics

print(topics(sys.argv[1:]).topics)
