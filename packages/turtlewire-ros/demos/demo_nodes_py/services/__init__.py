"""A service that adds two integers, and its clients."""
