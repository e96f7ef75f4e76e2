// Records the hierarchical depth buffer.
#include "effects/pyramid/pyramid.h"

#include "effects/levels.h"

#include <string>

namespace reflet {

gpu::Image makePyramid(gpu::PassList& f, gpu::Image depth, gpu::Image backDepth) {
    static_assert(pyramidLevels % 2 == 1, "each pass makes two levels above level 0");
    const uvec2 levels = levelsImageSize(depth.size, pyramidLevels);
    const gpu::Image pyramid =
        f.image("pyramid", VK_FORMAT_R32G32_SFLOAT, {depth.size.x + levels.x, glm::max(depth.size.y, levels.y)});
    for (uint32_t level = 1; level < pyramidLevels; level += 2) {
        f.compute("pyramid." + std::to_string(level), "pyramid.comp")
            .read("depth", depth)
            .read("backDepth", backDepth ? backDepth : depth)
            .write("pyramid", pyramid)
            .params(PyramidParams{depth.size, level, backDepth ? 1U : 0U})
            .dispatch(levelSize(depth.size, level + 1));
    }
    return pyramid;
}

}  // namespace reflet
