// The interface with which native code sends messages in any middleware.
#pragma once

#include <cstdint>
#include <span>

namespace turtlewire {

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
