// The Python class _native.JointRelay: JointStates answered without Python.
#pragma once

#include "python.hpp"

namespace turtlewire::python {

void add_joint_relay_type(nb::module_& module);

}  // namespace turtlewire::python
