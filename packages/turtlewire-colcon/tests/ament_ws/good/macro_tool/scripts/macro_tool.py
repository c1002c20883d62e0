#!/usr/bin/env python3
import macro_tool

macro_tool.main()
