"""The command ``ros2 bag``, and its functions for programs and extensions.

=========  ========================================
module     contents
=========  ========================================
`api`      values on the command line, QoS profiles
`command`  the command ``ros2 bag``
`verb`     its verbs
`options`  options that its verbs share
=========  ========================================
"""
