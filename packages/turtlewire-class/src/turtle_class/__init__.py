"""The classroom: the implementation of `turtlewire class`.

=================  ================================================================
module             contents
=================  ================================================================
`catalogue`        the exercises: the lessons of the browser tab, and more
`child`            the checks of one exercise of one student, in a separate process
`student`          the student's programs, in another process
`student_process`  that process, as the checks control it
`bus_link`         topics and services between these two processes
`seclusion`        isolates the student's process from the others
`supervise`        a script that ends a process with all its descendants
`runner`           starts a child with limits and reads its results
`grading`          all exercises of all students, several at a time
`pages`            results as pages without JavaScript, and as JUnit XML
`roster`           the names of the students, and their domains
`domain_watch`     the nodes, turtles and transforms of one student's domain
`show`             the page with a card for each student; its files are in `page/`
`class_command`    the command line of ``turtlewire class``
`commands`         the verbs that write reports and hand out files, launch files among them
=================  ================================================================
"""

__all__ = ["ClassError"]


class ClassError(Exception):
    """A command cannot run; the text says what was requested, what exists and what to do."""
