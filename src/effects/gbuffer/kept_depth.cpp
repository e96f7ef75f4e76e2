// Records the emulation of other depth buffer formats.
#include "effects/gbuffer/kept_depth.h"

#include <algorithm>

namespace reflet {

namespace {

constexpr float farDistance = 1000.0F;  // metres; substitute far plane of perspective views, which have none

}  // namespace

KeptDepthParams keptDepthParams(const ViewParams& view, DepthBuffer buffer) {
    // Reversed depth is near / distance in a perspective view, and 0 at the far plane of an orthographic one. The near
    // plane may itself be as far as 1000 m.
    const float near = view.depthToDistance.x;
    const float farDepth = view.eye.w > 0.0F ? near / std::max(farDistance, 2.0F * near) : 0.0F;
    const float steps = buffer == DepthBuffer::standard16 ? 65535.0F : 16777215.0F;
    return {farDepth, steps, uvec2(view.size)};
}

gpu::Image keptDepth(gpu::PassList& f, gpu::Image depth, const ViewParams& view, const DepthSettings& settings) {
    if (settings.format == DepthBuffer::reversedFloat) {
        return depth;
    }
    const gpu::Image kept = f.image("kept_depth", VK_FORMAT_R32_SFLOAT, depth.size);
    f.compute("kept_depth", "kept_depth.comp")
        .read("depth", depth)
        .write("kept", kept)
        .params(keptDepthParams(view, settings.format))
        .dispatch(depth.size);
    return kept;
}

}  // namespace reflet
