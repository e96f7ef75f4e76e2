// Queues and command buffers of a host.
#pragma once

#include "reflet/reflet.h"

#include <cstdint>
#include <vector>

namespace reflet::api {

/// The queue families that share the library's resources; empty: exclusive ownership. Throws Failure.
std::vector<uint32_t> queueFamiliesOf(const RefletContextInfo& info);

}  // namespace reflet::api
