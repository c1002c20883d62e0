#include "joint_frames.hpp"

#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "../feeds/joint_frames.hpp"

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
  auto out = nb::steal<nb::bytes>(
      PyBytes_FromStringAndSize(nullptr, static_cast<Py_ssize_t>(self.size())));
  if (!out.is_valid()) throw nb::python_error();
  auto* const begin = reinterpret_cast<unsigned char*>(bytes_start(out.ptr()));
  if (!self.write(span_of(joint_state), positions, begin))
    throw std::invalid_argument("the JointState ends within its positions");
  return out;
}

}  // namespace

void add_joint_frames_type(nb::module_& module) {
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
}

}  // namespace turtlewire::python
