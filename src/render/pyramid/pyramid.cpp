// Records the depth pyramid.
#include "render/pyramid/pyramid.h"

#include <string>

namespace reflet {

namespace {

uvec2 levelSize(uvec2 pixels, uint32_t level) {
    return (pixels + (1U << level) - 1U) >> level;
}

}  // namespace

gpu::Image makePyramid(gpu::Frame& f, gpu::Image depth, gpu::Image backDepth) {
    uint32_t rows = 0;
    for (uint32_t level = 1; level < pyramidLevels; ++level) {
        rows += levelSize(depth.size, level).y;
    }
    const gpu::Image pyramid = f.image("pyramid", VK_FORMAT_R32G32_SFLOAT, uvec2(levelSize(depth.size, 1).x, rows));
    for (uint32_t level = 1; level < pyramidLevels; ++level) {
        f.compute("pyramid." + std::to_string(level), "pyramid.comp")
            .read("depth", depth)
            .read("backDepth", backDepth ? backDepth : depth)
            .write("pyramid", pyramid)
            .params(PyramidParams{depth.size, level, backDepth ? 1U : 0U})
            .dispatch(levelSize(depth.size, level));
    }
    return pyramid;
}

}  // namespace reflet
