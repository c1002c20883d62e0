def shorten(name):
    return name.rpartition("/")[2]
