from diagnostic_msgs.msg import DiagnosticStatus


def status(name):
    return DiagnosticStatus(name=name, level=DiagnosticStatus.OK)
