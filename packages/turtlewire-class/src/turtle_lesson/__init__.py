"""The lesson's Python side: runs a student's nodes with turtlesim, and grades them.

It runs in a Web Worker (Pyodide) and, in the tests, under CPython.

===========  =================================================================
module       contents
===========  =================================================================
`lesson`     a lesson: its files, the programs that are started, its checks
`solution`   the solved files of a lesson: the starter files with a diff applied
`files`      the student's files as modules
`mistakes`   errors of the student's code: file, line, text and hint
`exercise`   a simulation in which the programs of a lesson run
`faults`     faults that a lesson can switch on
`session`    the programs that the page shows, run step by step
`screen`     turtlesim's picture as bytes for the page
`watch`     ``ros2 topic echo``, ``tf2_echo`` and the doctor, for the page
`grading`    runs the checks of a lesson
`classroom`  the functions that the page's worker calls
===========  =================================================================
"""
