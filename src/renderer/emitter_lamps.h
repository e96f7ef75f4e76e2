// Lamps that replace the emission of the scene's small bright emissive surfaces (scene/emitters.h).
#pragma once

#include "effects/lamps.h"
#include "scene/emitters.h"
#include "scene/pose.h"

#include <vector>

namespace reflet {

class EmitterLamps {
public:
    /// Finds the emitters at time 0. others: number of other lamps in the block.
    EmitterLamps(const Scene& scene, uint32_t others);

    void pose(const ScenePose& now);
    /// Whether the lamps replace all light that the material emits.
    [[nodiscard]] bool standFor(uint32_t material) const { return emitters_.materials.at(material); }
    void appendTo(LampBlock& block) const;

private:
    SceneEmitters emitters_;
    std::vector<mat4> worldToObject_;  ///< at time 0, per emitter
    std::vector<LampParams> lamps_;
};

}  // namespace reflet
