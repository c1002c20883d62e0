// Passes messages from Cyclone's thread to a sink.
#pragma once

#include <new>
#include <vector>

#include "../feeds/middleware.hpp"
#include "library.hpp"

namespace turtlewire::cyclone {

// Connects one reader with a sink, and triggers a guard condition when the sink asks for Python.
class Inlet {
 public:
  Inlet(const Library& library, Entity guard, Sink& sink)
      : library_(library), guard_(guard), sink_(sink) {}

  // The dds_on_data_available_fn, on the thread of Cyclone that received something, or on that of a
  // publisher in this process. It must not take the GIL: the thread that has it may be waiting for
  // a lock of Cyclone's that is held here.
  static void on_data(Entity reader, void* inlet) noexcept {
    static_cast<Inlet*>(inlet)->take_all(reader);
  }

 private:
  void take_all(Entity reader) noexcept {
    bool wanted = false;
    for (bool more = true; more;) {
      const Samples samples(library_, reader, Samples::kMost);
      more = samples.size() == Samples::kMost;
      for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples.valid(i)) wanted |= receive(samples, i);
      }
    }
    if (wanted) library_.trigger(guard_, true);
  }

  bool receive(const Samples& samples, std::size_t i) noexcept try {
    bytes_.resize(samples.bytes(i));
    samples.copy(i, bytes_.size(), bytes_.data());
    return sink_.receive(samples.publisher(i), samples.sent(i), bytes_);
  } catch (const std::bad_alloc&) {
    return false;  // the message is lost
  }

  const Library library_;
  const Entity guard_;
  Sink& sink_;
  std::vector<unsigned char> bytes_;  // Cyclone calls a listener on one thread at a time
};

}  // namespace turtlewire::cyclone
