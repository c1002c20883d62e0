// Prints Cyclone's last messages before it aborts the process.
#pragma once

namespace turtlewire::cyclone {

// Has the bytes that can be read from `pipe`, a non-blocking file descriptor, written on stderr
// when the process receives SIGABRT; what SIGABRT did before happens after that. Does nothing on
// Windows.
void print_on_abort(int pipe);

}  // namespace turtlewire::cyclone
