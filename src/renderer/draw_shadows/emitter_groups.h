// Emitters that share a shadow map, because there are more of them than maps.
#pragma once

#include "effects/lamps.h"

#include <vector>

namespace reflet {

struct EmitterGroup {
    std::vector<uint32_t> lamps;  ///< indices into the block
    LampParams seenFrom{};        ///< the lamp of the map, a sphere in the middle of the group
};

/// At most `most` groups of the emitters of the block, near one another.
std::vector<EmitterGroup> groupEmitters(const LampBlock& block, uint32_t most);

}  // namespace reflet
