"""Command lines, keys and text of terminals, for every command of every package.

==================  =================================================================
module              contents
==================  =================================================================
`parser`            a parser that suggests the nearest word; shared options; file names
`suggestion`        the nearest names to one that does not exist
`printable`         text from other processes, made safe for a terminal
`keyboard`          keys one by one, on the current platform
`posix_keyboard`    keys of a terminal of POSIX
`console_keyboard`  keys of the console of Windows
`signal_watch`      handles signals while the main thread waits
==================  =================================================================
"""
