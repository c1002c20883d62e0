// The Python classes _native.JointFrames and JointRelay: JointStates to TFMessages.
#include "../feeds/joints.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "../feeds/middleware.hpp"
#include "types.hpp"

namespace turtlewire::python {
namespace {

using namespace nb::literals;

using Places = std::vector<std::size_t>;
using Numbers = std::vector<double>;

std::span<const unsigned char> span_of(const nb::bytes& bytes) {
  return {reinterpret_cast<const unsigned char*>(bytes.c_str()), bytes.size()};
}

// Works on a tuple: an element's __float__ may change the list that it is in.
template <typename List>
List list_of(const nb::object& sequence) {
  List list;
  if (!nb::try_cast(nb::tuple(sequence), list))
    throw nb::type_error("the lists must hold numbers; those of places, integers");
  return list;
}

void make(JointFrames* self, const nb::bytes& message, const nb::object& stamp_places,
          const nb::object& pose_places, const nb::object& all_constants,
          const nb::object& all_sources, const nb::object& all_factors,
          const nb::object& all_offsets) {
  const auto stamps = list_of<Places>(stamp_places), poses = list_of<Places>(pose_places),
             sources = list_of<Places>(all_sources);
  const auto constants = list_of<Numbers>(all_constants), factors = list_of<Numbers>(all_factors),
             offsets = list_of<Numbers>(all_offsets);
  const std::size_t count = sources.size();
  for (const std::size_t size : {stamps.size(), poses.size(), factors.size(), offsets.size()})
    if (size != count) throw std::invalid_argument("the lists differ in length");
  if (constants.size() != 15 * count) throw std::invalid_argument("15 constants for each joint");
  std::vector<JointFrame> joints(count);
  for (std::size_t i = 0; i < count; ++i) {
    joints[i] = {{}, sources[i], factors[i], offsets[i], stamps[i], poses[i]};
    std::copy_n(constants.begin() + static_cast<std::ptrdiff_t>(15 * i), 15,
                joints[i].constants.begin());
  }
  const auto bytes = span_of(message);
  new (self) JointFrames({bytes.begin(), bytes.end()}, std::move(joints));
}

nb::bytes message(const JointFrames& self, const nb::bytes& joint_state, std::size_t positions) {
  const auto out = nb::cast<nb::bytes>(
      checked(PyBytes_FromStringAndSize(nullptr, static_cast<Py_ssize_t>(self.size()))));
  auto* const begin = reinterpret_cast<unsigned char*>(bytes_start(out.ptr()));
  if (!self.write(span_of(joint_state), positions, begin))
    throw std::invalid_argument("the JointState ends within its positions");
  return out;
}

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

void add_joint_types(nb::module_& module) {
  nb::class_<JointFrames>(
      module, "JointFrames",
      "Makes TFMessages of JointStates, both in CDR, for joints that were worked out before.\n\n"
      "Args:\n"
      "    template: A TFMessage whose stamps and poses are rewritten each time.\n"
      "    stamps: Where the stamp of each joint's transform begins.\n"
      "    poses: Where its seven numbers begin.\n"
      "    constants: 15 numbers for each joint; see turtlewire.urdf.joint_model.\n"
      "    sources: Which of the JointState's positions drives each joint.\n"
      "    factors: By what the position is multiplied.\n"
      "    offsets: What is added to it then.")
      .def("__init__", &make, "template"_a, "stamps"_a, "poses"_a, "constants"_a, "sources"_a,
           "factors"_a, "offsets"_a)
      .def("message", &message, "joint_state"_a, "positions"_a,
           "The TFMessage of a JointState whose first position is at a place.");
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
