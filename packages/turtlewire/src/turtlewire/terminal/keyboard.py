"""Keys, one by one as they are typed: of a terminal, or of the console of Windows.

Both kinds give the bytes that a terminal sends.
"""

import sys

if sys.platform == "win32":
    from turtlewire.terminal.console_keyboard import (
        ENDING_SIGNALS,
        foreground_terminal,
        signals_for_this_thread,
    )
    from turtlewire.terminal.console_keyboard import (
        ConsoleKeyboard as Keyboard,
    )
else:
    from turtlewire.terminal.posix_keyboard import (
        ENDING_SIGNALS,
        foreground_terminal,
        signals_for_this_thread,
    )
    from turtlewire.terminal.posix_keyboard import (
        PosixKeyboard as Keyboard,
    )

__all__ = ["ENDING_SIGNALS", "Keyboard", "foreground_terminal", "signals_for_this_thread"]
