def prefixed(name):
    return f"nav_{name}"
