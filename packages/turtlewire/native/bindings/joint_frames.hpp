// The Python class _native.JointFrames: JointStates to TFMessages.
#pragma once

#include "python.hpp"

namespace turtlewire::python {

void add_joint_frames_type(nb::module_& module);

}  // namespace turtlewire::python
