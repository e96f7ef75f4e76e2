// Records the min/max pyramid of a shadow map.
#include "effects/levels.h"
#include "effects/shadow/shadow.h"

#include <string>

namespace reflet {

namespace {

// Level 0, which is not stored.
uvec2 cellsOf(uvec2 map) {
    return levelSize(map, 2);
}

}  // namespace

uvec2 shadowRangeSize(uvec2 map) {
    return levelsImageSize(cellsOf(map), shadowRangeLevels);
}

void makeShadowRange(gpu::PassList& f, const ShadowMap& map, gpu::Image range) {
    constexpr ShadowShaders shaders{"shadow_range.comp", "shadow_range_host.comp", "shadow_range_layers.comp"};
    static_assert(shadowRangeLevels % 2 == 1, "each pass makes two levels from level 1 on");
    for (uint32_t level = 1; level < shadowRangeLevels; level += 2) {
        gpu::ComputePass pass = f.compute("shadow_range." + std::to_string(level), shaders.of(map));
        bindShadowMap(pass, map)
            .write("range", range)
            .constant("fromMap", level == 1 ? 1U : 0U)
            .params(ShadowRangeParams{map.size(), level})
            .dispatch(levelSize(cellsOf(map.size()), level + 1));
    }
}

}  // namespace reflet
