"""One adapter for each rival.

It is run as a script by the interpreter that has the rival, and prints its figures as JSON.
"""
