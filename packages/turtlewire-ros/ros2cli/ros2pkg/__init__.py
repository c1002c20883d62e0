"""The command ``ros2 pkg``, and its functions for programs and extensions.

===================  =========================================================
module               contents
===================  =========================================================
`api`                installed packages and their executables; steps of making
`command`            the command ``ros2 pkg``
`verb`               its verbs
`package_template`   files of a new package
`compiled_template`  files of a new package in C++ or Rust
===================  =========================================================
"""
