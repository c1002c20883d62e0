#include "joint_relay.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "../feeds/joint_relay.hpp"
#include "../feeds/outlet.hpp"
#include "../feeds/sink.hpp"

namespace turtlewire::python {
namespace {

using namespace nb::literals;

using Nanoseconds = JointRelay::Nanoseconds;
using Names = std::vector<std::string>;

class JointRelayObject final : public Sink {
 public:
  JointRelayObject(Outlet& outlet, std::size_t most_kept) : core(outlet, most_kept) {}

  JointRelay core;

  bool receive(std::uint64_t publisher, std::int64_t sent,
               std::span<const unsigned char> bytes) override {
    return core.receive(publisher, sent, bytes);
  }

  nb::list serve(const nb::object&) {
    nb::list list;
    if (const std::optional<WaitingMessage> kept = core.take())
      list.append(nb::make_tuple(nb::bytes(kept->bytes.data(), kept->bytes.size()), kept->publisher,
                                 kept->sent));
    return list;
  }

  void add_layout(const nb::bytes& head, std::size_t positions, std::size_t end,
                  const JointFrames& frames, Names names, bool moves) {
    const auto* const begin = reinterpret_cast<const unsigned char*>(head.c_str());
    core.add_layout(
        {{begin, begin + head.size()}, positions, end, frames, std::move(names), moves});
  }
};

}  // namespace

void add_joint_relay_type(nb::module_& module) {
  nb::class_<Outlet>(module, "Outlet",
                     "Native code that sends with a publisher; see turtlewire.wire.base.Outlet.");
  nb::class_<JointRelayObject, Sink>(
      module, "JointRelay",
      "A Sink that answers JointStates with TFMessages, on the thread that receives them and "
      "without "
      "Python.\n\n"
      "It keeps back what needs Python, and what comes behind that: JointStates without a layout "
      "that was added,\nthose that come when the clock was set back, skipped ones while Python "
      "wants to see them, and those whose\nanswer cannot be sent at once. serve returns one of "
      "them "
      "at a time. Safe for use from many "
      "threads. Times and stamps are in nanoseconds.\n\n"
      "Args:\n"
      "    outlet: Sends the TFMessages; it must not block.\n"
      "    most_kept: So many messages at most are kept back, the newest.")
      .def(nb::init<Outlet&, std::size_t>(), "outlet"_a, "most_kept"_a, nb::keep_alive<1, 2>())
      .def("serve", &JointRelayObject::serve, "gid_of"_a, "See turtlewire.wire.base.Sink.")
      .def(
          "set_rules",
          [](JointRelayObject& self, Nanoseconds interval, bool ignores_stamps,
             bool tells_of_skipping) {
            self.core.set_rules({interval, ignores_stamps, tells_of_skipping});
          },
          "interval"_a, "ignores_stamps"_a, "tells_of_skipping"_a,
          "By how much stamps must advance, whether that counts, and whether skipped messages are "
          "kept back.")
      .def(
          "set_time",
          [](JointRelayObject& self, std::optional<Nanoseconds> now) { self.core.set_time(now); },
          "now"_a.none(), "The time of a simulated clock, or None for the system's time.")
      .def(
          "add_layout", &JointRelayObject::add_layout, "head"_a, "positions"_a, "end"_a, "frames"_a,
          "names"_a, "moves"_a,
          "Answer JointStates that have these bytes behind the stamp, and positions from one place "
          "to another. Call it\nlast when one of them was handled: the relay goes on at once.")
      .def(
          "forget_layouts", [](JointRelayObject& self) { self.core.forget_layouts(); },
          "Keep all messages back until a layout is added.")
      .def(
          "earliest",
          [](JointRelayObject& self, const Names& names, Nanoseconds now) {
            return self.core.earliest(names, now);
          },
          "names"_a, "now"_a,
          "The smallest stamp published of these joints, 0 for a new one; `now` if all are later.")
      .def(
          "published",
          [](JointRelayObject& self, const Names& names, Nanoseconds stamp) {
            self.core.published(names, stamp);
          },
          "names"_a, "stamp"_a, "Python published a message of these joints.")
      .def(
          "moved_back",
          [](JointRelayObject& self, Nanoseconds now) { return self.core.moved_back(now); },
          "now"_a, "Whether the clock is behind the time of the last message; notes the time.")
      .def(
          "clear", [](JointRelayObject& self) { self.core.forget_stamps(); }, "Forget all stamps.")
      .def(
          "relayed", [](JointRelayObject& self) { return self.core.relayed(); },
          "The number of messages answered or skipped without Python.");
}

}  // namespace turtlewire::python
