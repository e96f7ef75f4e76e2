// Records the hierarchical depth buffer.
#include "effects/pyramid/pyramid.h"

#include "effects/levels.h"

#include <string>

namespace reflet {

gpu::Image makePyramid(gpu::PassList& f, gpu::Image depth, gpu::Image backDepth) {
    const gpu::Image pyramid = f.image("pyramid", VK_FORMAT_R32G32_SFLOAT, levelsImageSize(depth.size, pyramidLevels));
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
