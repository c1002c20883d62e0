#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "../feeds/middleware.hpp"
#include "../zenoh/origins.hpp"
#include "types.hpp"

namespace turtlewire::python {
namespace {

using namespace nb::literals;
using zenoh::Attachment;
using zenoh::Origins;

// Shorter ones are empty: the encapsulation takes four bytes.
constexpr std::size_t kShortest = 5;
// Passing on this many bytes takes about as long as releasing and acquiring the GIL.
constexpr std::size_t kLongBatch = 32768;

struct Message {
  nb::object bytes;
  Attachment attachment;

  std::span<const unsigned char> span() const {
    return {reinterpret_cast<const unsigned char*>(bytes_start(bytes.ptr())), size()};
  }
  std::size_t size() const { return static_cast<std::size_t>(PyBytes_Size(bytes.ptr())); }
};

// The bytes of a zenoh.ZBytes.
nb::object bytes_of(nb::handle zbytes) {
  nb::object bytes = zbytes.attr("to_bytes")();
  if (!PyBytes_CheckExact(bytes.ptr())) throw nb::type_error("to_bytes() returned no bytes");
  return bytes;
}

// Nothing if it has no attachment of rmw_zenoh_cpp, or is empty.
std::optional<Message> read(nb::handle sample) {
  const nb::object beside = sample.attr("attachment");
  if (beside.is_none()) return std::nullopt;
  const nb::object bytes = bytes_of(beside);
  const auto* first = reinterpret_cast<const unsigned char*>(bytes_start(bytes.ptr()));
  const std::optional<Attachment> attachment =
      Attachment::read({first, static_cast<std::size_t>(PyBytes_Size(bytes.ptr()))});
  if (!attachment) return std::nullopt;
  Message message{bytes_of(sample.attr("payload")), *attachment};
  if (message.size() < kShortest) return std::nullopt;
  return message;
}

class Inlet {
 public:
  explicit Inlet(Sink& sink) : sink_(sink) {}

  Origins origins;

  // Works on a tuple: an attribute of a sample may change the list that it is in.
  nb::tuple receive(const nb::list& given) {
    const nb::tuple samples(given);
    std::vector<Message> messages;
    messages.reserve(nb::len(samples));
    nb::list refused;
    std::size_t size = 0;
    for (const nb::handle sample : samples) {
      if (std::optional<Message> message = read(sample)) {
        size += message->size();
        messages.push_back(std::move(*message));
      } else {
        refused.append(sample);
      }
    }
    const auto [serve, lost] =
        size < kLongBatch ? hand_over(messages) : hand_over_unlocked(messages);
    return nb::make_tuple(serve, lost, refused);
  }

 private:
  struct Outcome {
    bool serve = false;
    std::uint64_t lost = 0;
  };

  Outcome hand_over(const std::vector<Message>& messages) {
    Outcome outcome;
    for (const Message& message : messages) {
      outcome.lost += origins.count_missing(message.attachment);
      const std::uint64_t publisher = Origins::publisher_of(message.attachment);
      outcome.serve =
          sink_.receive(publisher, message.attachment.sent, message.span()) || outcome.serve;
    }
    return outcome;
  }
  Outcome hand_over_unlocked(const std::vector<Message>& messages) {
    const Unlocked unlocked;
    return hand_over(messages);
  }

  Sink& sink_;
};

}  // namespace

void add_zenoh_types(nb::module_& module) {
  nb::class_<Inlet>(module, "ZenohInlet",
                    "Hands messages from a channel of Zenoh to a sink, which must outlive it.\n\n"
                    "Args:\n"
                    "    sink: Takes the messages.")
      .def(nb::init<Sink&>(), "sink"_a)
      .def("receive", &Inlet::receive, "samples"_a,
           "Hand over a batch of zenoh.Sample; a long one without the GIL. Returns whether the "
           "sink is to be\nserved, how many messages were lost before these, and the samples that "
           "are no message of\nrmw_zenoh_cpp.")
      .def(
          "gid_of",
          [](Inlet& self, std::uint64_t publisher) {
            const std::string gid = self.origins.gid_of(publisher);
            return nb::bytes(gid.data(), gid.size());
          },
          "publisher"_a,
          "The gid of a publisher that the sink knows by its number; empty if it is not known.")
      .def(
          "forget",
          [](Inlet& self, const nb::bytes& gid) { self.origins.forget({gid.c_str(), gid.size()}); },
          "gid"_a, "A publisher has gone: if it comes again, no message is lost in between.");
}

}  // namespace turtlewire::python
