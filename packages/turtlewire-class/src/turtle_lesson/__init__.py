"""The lesson's Python side: runs a student's nodes with turtlesim, and grades them.

It runs in a Web Worker (Pyodide) and, in the tests, under CPython.

===========  =================================================================
module       contents
===========  =================================================================
`lesson`     a lesson: its files, the programs that are started, its checks
`files`      the student's files as modules, and the solved files of a lesson
`mistakes`   errors of the student's code: file, line, text and hint
`exercise`   a simulation in which the programs of a lesson run
`session`    the programs that the page shows, run step by step; their picture and faults
`watch`     ``ros2 topic echo``, ``tf2_echo`` and the doctor, for the page
`grading`    runs the checks of a lesson
`classroom`  the functions that the page's worker calls
===========  =================================================================
"""
