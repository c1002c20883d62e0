"""The transform buffer, what fills it, and what shows it."""
