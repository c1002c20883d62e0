// The messages of bags: _native.mcap_messages, ros1_messages, Ros1ToCdr and ColumnReader.
#pragma once

#include "python.hpp"

namespace turtlewire::python {

void add_bag_message_types(nb::module_& module);

}  // namespace turtlewire::python
