"""Parameters of a node: asked for, and checked."""
