// Records the cleaning of the sun's visibility.
#include "render/shadow/shadow_clean.h"

namespace reflet {

gpu::Image cleanShadow(gpu::Frame& f, const GBuffer& g, gpu::Image visibility, gpu::Image penumbra,
                       ShadowCleanParams params) {
    const uvec2 size = visibility.size;
    const gpu::Image gathered = f.image("shadow_clean_gathered", VK_FORMAT_R32G32_UINT, size);
    const gpu::Image blurred = f.image("shadow_clean_blurred", VK_FORMAT_R32G32_UINT, size);
    const gpu::Image kernel = f.image("shadow_clean_kernel", VK_FORMAT_R32G32B32A32_UINT, size);
    const gpu::Image cleaned = f.image("shadow_clean", VK_FORMAT_R8_UNORM, size);
    const bool keeps = params.historyFrames > 0;
    const gpu::History history = f.history("shadow_clean", VK_FORMAT_R32G32_UINT, keeps ? size : uvec2(1));
    params.hasPrevious = keeps && history.valid ? 1 : 0;
    f.compute("shadow_clean.gather", "shadow_clean_gather.comp")
        .read("depth", g.depth)
        .read("geometricNormal", g.geometricNormal)
        .read("motion", g.motion)
        .read("visibility", visibility)
        .read("penumbra", penumbra)
        .read("previous", history.previous)
        .write("next", history.next)
        .write("gathered", gathered)
        .write("kernel", kernel)
        .params(params)
        .dispatch(size);
    for (const uint32_t last : {0U, 1U}) {
        f.compute(last == 0 ? "shadow_clean.blur_1" : "shadow_clean.blur_2", "shadow_clean_blur.comp")
            .read("from", last == 0 ? gathered : blurred)
            .read("kernel", kernel)
            .write("blurred", last == 0 ? blurred : gathered)
            .write("cleaned", cleaned)
            .params(ShadowBlurParams{size})
            .constant("last", last)
            .dispatch(size);
    }
    return cleaned;
}

}  // namespace reflet
