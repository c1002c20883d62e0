#include "arrays.hpp"

#include <nanobind/stl/string.h>

namespace turtlewire::python {

using namespace nb::literals;

Stamps stamps_of(nb::handle object) {
  Stamps stamps;
  if (nb::try_cast(object, stamps, false)) return stamps;
  const nb::module_ numpy = nb::module_::import_("numpy");
  const nb::object array = numpy.attr("asarray")(object);
  const std::string kind = nb::cast<std::string>(array.attr("dtype").attr("kind"));
  if (kind != "i" && kind != "u" && nb::cast<std::size_t>(array.attr("size")) != 0) {
    throw nb::type_error("stamps must be integers (nanoseconds)");
  }
  const nb::object plain = numpy.attr("ascontiguousarray")(array, "dtype"_a = "int64");
  if (nb::cast<int>(plain.attr("ndim")) != 1 || nb::cast<int>(array.attr("ndim")) != 1) {
    throw nb::value_error("stamps must be one-dimensional");
  }
  return nb::cast<Stamps>(plain);
}

}  // namespace turtlewire::python
