// Records tone mapping.
#include "effects/tonemap/tonemap.h"

namespace reflet {

gpu::Image tonemap(gpu::PassList& f, gpu::Image radiance, const TonemapSettings& settings, gpu::Image exposure) {
    const gpu::Image display = f.image("display", VK_FORMAT_R8G8B8A8_UNORM, radiance.size);
    gpu::ComputePass pass = f.compute("tonemap", exposure ? "tonemap_auto.comp" : "tonemap.comp");
    if (exposure) {
        pass.read("exposure", exposure);
    }
    pass.constant("curve", static_cast<uint32_t>(settings.curve))
        .read("radiance", radiance)
        .write("display", display)
        .params(TonemapParams{settings, radiance.size})
        .dispatch(radiance.size);
    return display;
}

}  // namespace reflet
