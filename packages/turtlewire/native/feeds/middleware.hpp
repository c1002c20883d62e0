// What a middleware's native code and ours hand each other, on any thread and without Python.
#pragma once

#include <cstdint>
#include <span>

namespace turtlewire {

// Gets the messages that a middleware's native code receives, on its own threads.
class Sink {
 public:
  Sink() = default;
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;
  virtual ~Sink() = default;

  // Takes the bytes of a message, with its encapsulation. `publisher` is the middleware's number of
  // the publisher, `sent` the time of sending in nanoseconds. True if the middleware's reader
  // thread must serve this sink in Python now: see Sink in turtlewire/wire/base.py. Must not take
  // the GIL.
  virtual bool receive(std::uint64_t publisher, std::int64_t sent,
                       std::span<const unsigned char> bytes) = 0;
};

// Sends messages in any middleware.
class Outlet {
 public:
  Outlet() = default;
  Outlet(const Outlet&) = delete;
  Outlet& operator=(const Outlet&) = delete;
  virtual ~Outlet() = default;

  // Sends the bytes of a message, with its encapsulation. A negative code if that failed. Any
  // thread may call it, also after the middleware's writer has gone. May block if the publisher
  // does.
  virtual std::int32_t send(std::span<const unsigned char> bytes) = 0;
};

}  // namespace turtlewire
