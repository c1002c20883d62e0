// What a middleware's native code hands messages to, on its own threads and without Python.
#pragma once

#include <cstdint>
#include <span>

namespace turtlewire {

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

}  // namespace turtlewire
