// Waits for data with the GIL released; Ctrl-C ends the wait.
#pragma once

#include <nanobind/nanobind.h>

#include <atomic>
#include <chrono>
#include <cstdint>

#include "../core/shared_buffer.hpp"
#include "gil.hpp"

namespace turtlewire::python {

namespace nb = nanobind;

// Python's own lock, as threading.Lock is: the only portable way to sleep that a signal interrupts.
class Sleeper final : public Waiter {
 public:
  Sleeper() : lock_(PyThread_allocate_lock()) {
    if (lock_ != nullptr) PyThread_acquire_lock(lock_, WAIT_LOCK);
  }
  Sleeper(const Sleeper&) = delete;
  Sleeper& operator=(const Sleeper&) = delete;
  ~Sleeper() {
    if (lock_ == nullptr) return;
    PyThread_release_lock(lock_);
    PyThread_free_lock(lock_);
  }

  bool valid() const { return lock_ != nullptr; }

  void wake() noexcept override {
    if (!awake_.exchange(true)) PyThread_release_lock(lock_);
  }

  // Sleeps until woken or for `microseconds`; true if a signal may have come. Call without the GIL.
  bool sleep(std::int64_t microseconds) {
    const PyLockStatus status = PyThread_acquire_lock_timed(lock_, microseconds, 1);
    if (status == PY_LOCK_ACQUIRED) awake_ = false;
    return status == PY_LOCK_INTR;
  }

 private:
  PyThread_type_lock lock_;
  std::atomic<bool> awake_ = false;
};

enum class Waited : std::uint8_t { done, python_error };

// Repeats `attempt` whenever data comes in, until it returns true or the time is over; it runs
// without the GIL. `interrupts` counts the calls of Buffer.wake(): after one, and after a signal,
// Python's signal handlers run, and an exception that they raise ends the wait.
template <typename Attempt>
Waited wait_until(SharedBuffer& shared, const std::atomic<std::uint64_t>& interrupts,
                  std::int64_t timeout_ns, Attempt attempt) {
  using Clock = std::chrono::steady_clock;
  constexpr std::int64_t longest_sleep_us = 3'600'000'000;
  Sleeper sleeper;
  if (!sleeper.valid()) {
    PyErr_NoMemory();
    return Waited::python_error;
  }
  const auto start = Clock::now();
  const Waiting known(shared, sleeper);
  std::uint64_t seen = interrupts;
  for (;;) {
    bool over = false, signalled = false;
    {
      const Unlocked unlocked;
      while (!over && !signalled) {
        over = attempt();
        const std::int64_t left =
            timeout_ns - std::chrono::nanoseconds(Clock::now() - start).count();
        over = over || left <= 0;
        if (!over)
          signalled =
              sleeper.sleep(std::min((left + 999) / 1000, longest_sleep_us)) || interrupts != seen;
      }
    }
    if (over) return Waited::done;
    seen = interrupts;
    if (taking_gil(PyErr_CheckSignals) != 0) return Waited::python_error;
  }
}

}  // namespace turtlewire::python
