// Records the compositing of blended surfaces.
#include "renderer/blend/blend.h"

namespace reflet {

bool showsBlended(const DrawList& list, const ViewParams& view) {
    return anyDraws(list, {.keep = [](const Draw& draw) { return draw.blended; }, .worldToClip = view.worldToClip});
}

void blendLayer(gpu::PassList& f, gpu::Image accumulated, gpu::Image radiance, const BlendedLayer& layer,
                BlendSide side) {
    f.compute("blend_layer", "blend_layer.comp")
        .constant("side", static_cast<uint32_t>(side))
        .read("radiance", radiance)
        .read("motion", layer.motion)
        .read("depth", layer.depth)
        .read("glassDepth", side == BlendSide::all ? layer.depth : layer.glassDepth)
        .write("accumulated", accumulated)
        .params(BlendLayerParams{accumulated.size, layer.first ? 1U : 0U})
        .dispatch(accumulated.size);
}

namespace {

void compositeOver(gpu::PassList& f, gpu::Image accumulated, gpu::Image behind, gpu::Image over, uint32_t coverage) {
    f.compute("blend_over", "blend_over.comp")
        .read("accumulated", accumulated)
        .read("behind", behind)
        .write("over", over)
        .params(BlendOverParams{over.size, coverage})
        .dispatch(over.size);
}

}  // namespace

void blendOver(gpu::PassList& f, gpu::Image accumulated, gpu::Image behind, gpu::Image over) {
    compositeOver(f, accumulated, behind, over, 0);
}

void coverOver(gpu::PassList& f, gpu::Image accumulated, gpu::Image behind, gpu::Image over) {
    compositeOver(f, accumulated, behind, over, 1);
}

gpu::Image coverageOf(gpu::PassList& f, gpu::Image accumulated) {
    const gpu::Image covered = f.image("blend.covered", VK_FORMAT_R32_SFLOAT, accumulated.size);
    f.compute("blend_coverage", "blend_coverage.comp")
        .read("accumulated", accumulated)
        .write("covered", covered)
        .params(BlendOverParams{covered.size, 0})
        .dispatch(covered.size);
    return covered;
}

gpu::Image blendAntialiased(gpu::PassList& f, gpu::Image radiance, gpu::Image covered, gpu::Image behind) {
    const gpu::Image over = f.image("blend.antialiased", VK_FORMAT_R16G16B16A16_SFLOAT, behind.size);
    f.compute("blend_antialiased", "blend_antialiased.comp")
        .read("radiance", radiance)
        .read("covered", covered)
        .read("behind", behind)
        .write("over", over)
        .params(BlendOverParams{over.size, 0})
        .dispatch(over.size);
    return over;
}

}  // namespace reflet
