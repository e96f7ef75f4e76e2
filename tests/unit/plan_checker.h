// Says what is wrong with a plan for a list of passes, by looking at every pair of uses.
#pragma once

#include "gpu/plan.h"

#include <string>

namespace reflet::test {

/// Empty: nothing. What is checked: the passes that are needed, their order, memory that two share at a time, and a
/// barrier between any two accesses that conflict, also of two resources in the same memory.
std::string faultOf(const gpu::PassGraph& graph, const gpu::Plan& plan);

}  // namespace reflet::test
