"""The ros2 command.

A command is a module in :mod:`ros2cli.commands`; its verbs, where it has some, are modules beside
it. Nothing is imported before it is needed: only the command and the verb on the command line are
loaded.
"""
