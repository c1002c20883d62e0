"""What the actions and descriptions of nodes have in common: arguments, and elements of files."""
