#include "arrays.hpp"

#include <nanobind/stl/string.h>

namespace turtlewire::python {
namespace {

Stamps integers_of(nb::handle object) {
  Stamps stamps;
  if (is_array(object, stamps)) return stamps;
  return nb::cast<Stamps>(checked_array("stamp_array", object));
}

}  // namespace

nb::object checked_array(const char* function, nb::handle object) {
  return checked(call_python("turtlewire.tf.array_arguments", function, "(O)", object.ptr()));
}

nb::object make_answer(const char* name, const nb::tuple& fields) {
  return checked(call_python("turtlewire.tf.answers", name, "O", fields.ptr()));
}

Stamps stamps_of(nb::handle object) {
  const Stamps stamps = integers_of(object);
  const Stamp* const end = stamps.data() + stamps.shape(0);
  if (std::find(stamps.data(), end, kLatest) != end)
    throw nb::value_error("a time is NaT (not a time)");
  return stamps;
}

}  // namespace turtlewire::python
