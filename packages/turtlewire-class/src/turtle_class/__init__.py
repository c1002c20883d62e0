"""The classroom: what `turtlewire class` does.

=================  ================================================================
module             what it holds
=================  ================================================================
`catalogue`        the exercises: the lessons of the browser tab, and more
`child`            the checks of one exercise of one student, in a process of their own
`student`          the student's programs, in another one
`student_process`  what the checks see of that process
`bus_link`         topics and services between the two
`seclusion`        keeps the student's process out of the others
`supervise`        a script that ends a process and all that it started
`runner`           starts a child with limits and reads its results
`grading`          all exercises of all students, several at a time
`junit`            results as JUnit XML
`pages`            results as pages without JavaScript
`launch_file`      a launch file for an exercise, for the wire
`roster`           who is in the class, and in which domain
`domain_watch`     what is known of one student's domain
`show`             the page with a card for each student; its files are in `page/`
`class_command`    the words and options of ``turtlewire class``
`commands`         the verbs that write reports and hand out files
=================  ================================================================
"""

__all__ = ["ClassError"]


class ClassError(Exception):
    """What keeps a command from running; the text says what was asked, exists and helps."""
