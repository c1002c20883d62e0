"""Carries topics, services and actions between two networks: ``turtlewire relay``.

================  =================================================================
module            contents
================  =================================================================
`side`            one end: its name, context, nodes, their mark, and the thread
`direction`       opens and closes routes from one end to the other
`routes`          one topic or service
`relay`           `Relay`, which follows the changes at both ends; other names
================  =================================================================
"""
