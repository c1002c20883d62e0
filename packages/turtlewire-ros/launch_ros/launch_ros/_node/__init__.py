"""The common parts of actions and descriptions of nodes: arguments, and elements of files."""
