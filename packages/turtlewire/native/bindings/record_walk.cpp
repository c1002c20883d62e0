#include "../feeds/record_walk.hpp"

#include <nanobind/stl/string.h>

#include <cstdint>
#include <vector>

#include "buffer.hpp"
#include "bytes.hpp"
#include "types.hpp"

namespace turtlewire::python {
namespace {

using namespace nb::literals;

std::vector<TfChannel> channels_of(const nb::dict& channels) {
  std::vector<TfChannel> list;
  for (const auto& [id, description] : channels) {
    const auto pair = nb::cast<nb::tuple>(description);
    list.push_back(
        {nb::cast<std::uint16_t>(id), nb::cast<std::string>(pair[0]), nb::cast<bool>(pair[1])});
  }
  return list;
}

std::int64_t walk(RecordWalk& self, BufferObject& buffer, nb::handle records,
                  const nb::dict& channels) {
  Bytes bytes;
  if (!bytes.read(records.ptr())) throw nb::python_error();
  const std::vector<TfChannel> wanted = channels_of(channels);
  std::size_t damage = 0;
  {
    const Unlocked unlocked;
    damage = self.walk(buffer.shared, bytes.span(), wanted);
  }
  buffer.call_listeners();
  return damage == RecordWalk::kNoDamage ? -1 : static_cast<std::int64_t>(damage);
}

nb::list jumps(const RecordWalk& self) {
  nb::list list;
  for (const JumpBack& jump : self.jumps())
    list.append(nb::make_tuple(jump.log_time, checked(to_python(jump.child)), jump.by));
  return list;
}

nb::dict steps_back(const RecordWalk& self) {
  nb::dict steps;
  for (const auto& [child, clock] : self.clocks()) {
    if (clock.back > 0)
      steps[checked(to_python(child))] = nb::make_tuple(clock.steps_back, clock.back);
  }
  return steps;
}

}  // namespace

void add_record_walk_type(nb::module_& module) {
  nb::class_<RecordWalk>(
      module, "RecordWalk",
      "Walks the records of MCAP chunks and adds the TFMessages among them to a buffer.\n\n"
      "One thread at a time may use it. Messages that are no TFMessages are counted by the\n"
      "buffer, as those of `add_tf_message` are.\n\n"
      "Args:\n"
      "    start_ns: The first log time of the messages that are taken.\n"
      "    end_ns: The last log time.")
      .def(nb::init<std::uint64_t, std::uint64_t>(), "start_ns"_a, "end_ns"_a)
      .def("walk", &walk, "buffer"_a, "records"_a, "channels"_a.lock(),
           "Adds the messages of a chunk's decompressed records, without the GIL.\n\n"
           "Args:\n"
           "    buffer: Where to.\n"
           "    records: The bytes.\n"
           "    channels: By the number of a channel: who sends on it, and whether its transforms\n"
           "        are static. Other channels are passed over.\n\n"
           "Returns:\n"
           "    Where the first record begins that is cut off, all before it being added; -1 if\n"
           "    none is.")
      .def_prop_ro("messages", &RecordWalk::messages, "How many messages were taken.")
      .def_prop_ro("jumps", &jumps,
                   "Where stamps fall back by more than a second: log time, the child frame of the "
                   "message's first transform, and by how much, in nanoseconds.")
      .def_prop_ro("steps_back", &steps_back,
                   "How many stamps of such a frame lie before its newest, and the largest step "
                   "back in nanoseconds, if there is one.");
}

}  // namespace turtlewire::python
