// Records the debug pass for one pixel's shadow and reads it back.
#include "effects/shadow/record_shadow.h"

#include <algorithm>
#include <cstring>

namespace reflet {

gpu::Readback recordShadow(gpu::PassList& f, const GBuffer& g, const ShadowInputs& in,
                           const RecordShadowParams& params) {
    const gpu::Image record =
        f.image("shadow_record", VK_FORMAT_R32G32B32A32_SFLOAT, uvec2(recordedShadowHead + recordedShadowTexels, 1));
    const gpu::Image map = in.map ? in.map.image : g.depth;
    f.compute("record_shadow", "record_shadow.comp")
        .read("depth", g.depth)
        .read("geometricNormal", g.geometricNormal)
        .read("shadowMap", map)
        .read("range", in.range ? in.range : map)
        .write("record", record)
        .params(params)
        .constant("filterKind", static_cast<uint32_t>(params.settings.filter))
        .constant("hasRanges", in.range ? 1 : 0)
        .constant("cascades", params.sun.count)
        .constant("biasKind", static_cast<uint32_t>(params.settings.biasKind))
        .dispatch(1);
    return f.readback(record);
}

RecordedShadow recordedShadow(const gpu::Recorder& f, gpu::Readback readback) {
    std::vector<vec4> texels(recordedShadowHead + recordedShadowTexels);
    std::memcpy(texels.data(), f.bytes(readback).data(), texels.size() * sizeof(vec4));
    RecordedShadow shadow;
    shadow.lookups = static_cast<uint32_t>(texels[0].x);
    shadow.visibility = texels[0].y;
    shadow.penumbraWidth = texels[0].z;
    shadow.blockerHeight = texels[0].w;
    shadow.point = vec3(texels[1]);
    for (uint32_t i = 0; i < std::min(shadow.lookups, recordedShadowTexels); ++i) {
        const vec4& texel = texels[recordedShadowHead + i];
        if (texel.w >= 0.0F) {
            shadow.texels.push_back({vec3(texel), texel.w != 0.0F});
        }
    }
    return shadow;
}

}  // namespace reflet
