#include "abort.hpp"

#ifndef _WIN32
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#endif

namespace turtlewire::cyclone {

#ifdef _WIN32

void print_on_abort(int) {}

#else

namespace {

std::atomic<int> read_end = -1;
struct sigaction former;

// Only functions that POSIX allows in a signal handler.
void print_and_abort(int signal_number) {
  const int error = errno;
  char block[4096];
  for (;;) {
    const ssize_t size = ::read(read_end.load(), block, sizeof block);
    if (size <= 0 || ::write(STDERR_FILENO, block, static_cast<std::size_t>(size)) < 0) break;
  }
  ::sigaction(SIGABRT, &former, nullptr);
  errno = error;
  ::raise(signal_number);
}

}  // namespace

void print_on_abort(int pipe) {
  const bool installed = read_end.exchange(pipe) != -1;
  if (installed) return;
  struct sigaction action = {};
  action.sa_handler = print_and_abort;
  action.sa_flags = SA_NODEFER;  // the former handler is called inside this one
  ::sigaction(SIGABRT, &action, &former);
}

#endif

}  // namespace turtlewire::cyclone
