// Records tone mapping.
#include "render/tonemap/tonemap.h"

namespace reflet {

gpu::Image tonemap(gpu::Frame& f, gpu::Image radiance, const TonemapSettings& settings) {
    const gpu::Image display = f.image("display", VK_FORMAT_R8G8B8A8_UNORM, radiance.size);
    f.compute("tonemap", "tonemap.comp")
        .constant("curve", static_cast<uint32_t>(settings.curve))
        .read("radiance", radiance)
        .write("display", display)
        .params(TonemapParams{settings, radiance.size})
        .dispatch(radiance.size);
    return display;
}

}  // namespace reflet
