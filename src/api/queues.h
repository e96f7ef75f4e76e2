// Queues and command buffers of a host.
#pragma once

#include "reflet/reflet.h"

#include <cstdint>
#include <vector>

namespace reflet::api {

/// The families that share what the library makes; empty: one at a time. Throws Failure.
std::vector<uint32_t> queueFamiliesOf(const RefletContextInfo& info);

}  // namespace reflet::api
