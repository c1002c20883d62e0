"""The lesson's Python side: runs a student's nodes with turtlesim, and grades them.

It runs in a Web Worker (Pyodide) and, in the tests, under CPython.

===========  =================================================================
module       contents
===========  =================================================================
`lesson`     a lesson: its files, programs and checks; the student's files as modules
`mistakes`   errors of the student's code: file, line, text and hint
`exercise`   a simulation in which the programs of a lesson run
`session`    the programs that the page shows, run step by step; their picture, faults and panels:
             ``ros2 topic echo``, ``tf2_echo`` and the doctor
`grading`    runs the checks of a lesson
`classroom`  the functions that the page's worker calls
===========  =================================================================
"""
