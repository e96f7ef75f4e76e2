// Records the import of a host's images.
#include "lighting/host_images.h"

namespace reflet::lighting {

Surfaces importSurfaces(gpu::PassList& f, const HostSurfaces& host, const ImportParams& params) {
    const ImportedSurfaces imported = reflet::importSurfaces(f, host, params);
    return {.g = imported.g,
            .backDepth = imported.backDepth,
            .shownDepth = imported.shownDepth,
            .reactive = imported.reactive,
            .pyramid = {},
            .ambientOcclusion = {}};
}

gpu::Image importLight(gpu::PassList& f, gpu::Image light, const LightImport& how) {
    return reflet::importLight(f, light, how);
}

LightBound boundLight(gpu::PassList& f, LightBoundStore& own, uvec2 size, const LightBoundFrame& frame) {
    return reflet::boundLight(f, own, size, frame);
}

void measureLight(gpu::PassList& f, LightBound& bound, gpu::Image light) {
    reflet::measureLight(f, bound, light);
}

}  // namespace reflet::lighting
