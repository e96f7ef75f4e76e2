// Records the running means.
#include "effects/accumulate/accumulate.h"

namespace reflet {

LightLayers accumulate(gpu::PassList& f, AccumulateStore& own, const LightLayers& frame, uint32_t framesBefore) {
    constexpr VkFormat exact = VK_FORMAT_R32G32B32A32_SFLOAT;
    const uvec2 size = frame.direct.size;
    const gpu::History direct = own.direct.swap(f, exact, size);
    const gpu::History diffuse = own.indirectDiffuse.swap(f, exact, size);
    const gpu::History specular = own.indirectSpecular.swap(f, exact, size);
    const gpu::Image lit = f.image("accumulated_lit", exact, size);
    const float frames = direct.valid ? static_cast<float>(framesBefore) + 1.0F : 1.0F;
    f.compute("accumulate", "accumulate.comp")
        .read("direct", frame.direct)
        .read("indirectDiffuse", frame.indirectDiffuse)
        .read("indirectSpecular", frame.indirectSpecular)
        .read("directBefore", direct.previous)
        .read("indirectDiffuseBefore", diffuse.previous)
        .read("indirectSpecularBefore", specular.previous)
        .write("directMean", direct.next)
        .write("indirectDiffuseMean", diffuse.next)
        .write("indirectSpecularMean", specular.next)
        .write("litMean", lit)
        .params(AccumulateParams{size, 1.0F / frames})
        .dispatch(size);
    return {direct.next, diffuse.next, specular.next, lit};
}

}  // namespace reflet
