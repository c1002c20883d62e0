// Giving the GIL away and taking it again, also while the interpreter ends.
#pragma once

#include <Python.h>

#include <chrono>
#include <thread>
#include <utility>
#if defined(__GLIBCXX__)
#include <cxxabi.h>
#endif

namespace turtlewire::python {

// Calls `function`, which may take the GIL: it gives it back, or runs Python code.
//
// Before version 3.14, CPython ends a daemon thread that asks for the GIL after the interpreter
// began to end. glibc's pthread_exit() then unwinds the stack: destructors run without the GIL, and
// the first noexcept function aborts the process. This function stops the unwinding and blocks the
// thread until the process has ended, which is what CPython does since 3.14. `function` itself must
// therefore hold nothing that has a destructor.
template <typename Function>
decltype(auto) taking_gil(Function&& function) {
#if defined(__GLIBCXX__)
  try {
    return std::forward<Function>(function)();
  } catch (const abi::__forced_unwind&) {
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
  }
#else  // elsewhere pthread_exit() ends the thread without unwinding
  return std::forward<Function>(function)();
#endif
}

// Releases the GIL for as long as it lives.
class Unlocked {
 public:
  Unlocked() : state_(PyEval_SaveThread()) {}
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;
  ~Unlocked() {
    taking_gil([this] { PyEval_RestoreThread(state_); });
  }

 private:
  PyThreadState* state_;
};

}  // namespace turtlewire::python
