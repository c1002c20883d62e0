"""The lesson's Python side: runs a student's nodes beside turtlesim, and grades them.

It runs in a Web Worker (Pyodide), and the same under CPython, where its tests are.

===========  =================================================================
module       what it holds
===========  =================================================================
`lesson`     a lesson: its files, the programs that are started, its checks
`solution`   its solved files, made from the first ones by a diff
`files`      the student's files as modules
`mistakes`   errors of the student's code: file, line, text and hint
`exercise`   a simulation in which the programs of a lesson run
`faults`     faults that a lesson can switch on
`session`    what the page shows: run, stepped and watched
`screen`     turtlesim's picture as bytes for the page
`watch`     ``ros2 topic echo``, ``tf2_echo`` and the doctor, for the page
`grading`    runs the checks of a lesson
`classroom`  what the worker of the page calls
===========  =================================================================
"""
