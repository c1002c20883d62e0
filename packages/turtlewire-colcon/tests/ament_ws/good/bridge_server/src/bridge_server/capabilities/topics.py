from bridge_msgs.srv import Topics


def topics(names):
    return Topics.Response(topics=sorted(names))
