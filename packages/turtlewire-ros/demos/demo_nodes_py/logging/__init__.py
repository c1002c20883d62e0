"""The services that change the level of a logger."""
