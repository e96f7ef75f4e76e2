// Records the mips of a radiance image.
#include "effects/light_mips/light_mips.h"

#include "effects/levels.h"

#include <algorithm>
#include <bit>
#include <string>

namespace reflet {

gpu::Image makeLightMips(gpu::PassList& f, gpu::Image light) {
    const auto levels = 1U + static_cast<uint32_t>(std::bit_width(std::max(light.size.x, light.size.y) - 1U));
    const gpu::Image mips = f.image("light_mips", VK_FORMAT_R16G16B16A16_SFLOAT, levelsImageSize(light.size, levels));
    for (uint32_t level = 1; level < levels; ++level) {
        f.compute("light_mips." + std::to_string(level), "light_mips.comp")
            .read("light", light)
            .write("mips", mips)
            .params(LightMipsParams{light.size, level})
            .dispatch(levelSize(light.size, level));
    }
    return mips;
}

}  // namespace reflet
