// Records the debug pass for one ray and reads it back.
#include "effects/lobe/record_ray.h"

#include "effects/pyramid/pyramid.h"

#include <algorithm>
#include <cstring>

namespace reflet {

gpu::Readback recordRay(gpu::Recorder& f, RecordRayStore& own, const RecordRayInputs& in, const ViewParams& view,
                        const TraceScreenSettings& settings, uvec2 pixel) {
    const gpu::Image record =
        own.record.storage(f, VK_FORMAT_R32G32B32A32_SFLOAT, uvec2(recordHead + recordedSteps, 1));
    const gpu::Image pyramid = in.pyramid ? in.pyramid : makePyramid(f, own.pyramid, in.g.depth, in.backDepth);
    f.compute("record_ray", "record_ray.comp")
        .read("depth", in.g.depth)
        .read("normal", in.g.normal)
        .read("geometricNormal", in.g.geometricNormal)
        .read("backDepth", in.backDepth ? in.backDepth : in.g.depth)
        .read("pyramid", pyramid)
        .write("record", record)
        .params(RecordRayParams{view, settings, pixel, in.backDepth ? 1U : 0U})
        .dispatch(1);
    return f.readback(record);
}

std::optional<RecordedRay> recordedRay(const gpu::Recorder& f, gpu::Readback readback) {
    std::vector<vec4> texels(recordHead + recordedSteps);
    std::memcpy(texels.data(), f.bytes(readback).data(), texels.size() * sizeof(vec4));
    if (texels[0].x < 0.0F) {
        return std::nullopt;
    }
    RecordedRay ray;
    ray.outcome = static_cast<RayOutcome>(texels[0].x);
    ray.pixel = uvec2(texels[0].y, texels[0].z);
    ray.distance = texels[0].w;
    ray.clear = texels[1].x;
    ray.lost = texels[1].y != 0.0F;
    ray.facesAway = texels[1].w != 0.0F;
    ray.confidence = texels[2].x;
    ray.edge = texels[2].y;
    ray.far = texels[2].z;
    ray.camera = texels[2].w;
    ray.direction = vec3(texels[3]);
    ray.start = vec3(texels[4]);
    ray.samples = static_cast<uint32_t>(texels[3].w);
    for (uint32_t i = 0; i < std::min(ray.samples, recordedSteps); ++i) {
        const vec4& step = texels[recordHead + i];
        ray.steps.push_back({uvec2(step.x, step.y), static_cast<uint32_t>(step.z), step.w});
    }
    return ray;
}

}  // namespace reflet
