// The lock of a buffer, which lookups share where they run at the same time.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <mutex>

namespace turtlewire {

// With a GIL, lookups come one by one, and one mutex is the quickest lock.
#if !defined(TURTLEWIRE_READER_LOCKS)
#define TURTLEWIRE_READER_LOCKS 1
#endif
inline constexpr std::size_t kReaderLocks = TURTLEWIRE_READER_LOCKS;

// A lock that one thread holds to change things, or several hold to read. A reading thread takes
// its own of several mutexes, each in a cache line of its own: a single counter of readers would
// travel from core to core with every lookup. A thread that changes things takes them all.
//
// It is released by the thread that took it. Nothing is taken twice, nor changed from one kind of
// holding to the other.
class SharedLock {
 public:
  void lock() {
    for (Slot& slot : slots_) slot.mutex.lock();
  }
  void unlock() {
    for (Slot& slot : slots_) slot.mutex.unlock();
  }
  void lock_shared() { own().lock(); }
  void unlock_shared() { own().unlock(); }

 private:
  static constexpr std::size_t kCacheLine = 64;
  struct alignas(kReaderLocks > 1 ? kCacheLine : alignof(std::mutex)) Slot {
    std::mutex mutex;
  };

  std::mutex& own() {
    if constexpr (kReaderLocks == 1) return slots_[0].mutex;
    return slots_[number_of_thread() % kReaderLocks].mutex;
  }
  static std::size_t number_of_thread() {
    static constinit std::atomic<std::size_t> count = 0;
    constinit static thread_local std::size_t number = 0;  // from 1 on
    if (number == 0) [[unlikely]]
      number = ++count;
    return number;
  }

  std::array<Slot, kReaderLocks> slots_;
};

}  // namespace turtlewire
