// Emitters that share a shadow map, because there are more of them than maps.
#pragma once

#include "effects/lamps.h"

#include <vector>

namespace reflet {

struct EmitterGroup {
    std::vector<uint32_t> lamps;  ///< indices into the block
    LampParams seenFrom{};        ///< lamp that the map is rendered from, a sphere in the middle of the group
};

/// Groups nearby emitters of the block, into at most `most` groups.
std::vector<EmitterGroup> groupEmitters(const LampBlock& block, uint32_t most);

}  // namespace reflet
