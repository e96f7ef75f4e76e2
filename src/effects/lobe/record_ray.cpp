// Records the debug pass for one ray and reads it back.
#include "effects/lobe/record_ray.h"

#include "effects/pyramid/pyramid.h"

#include <algorithm>
#include <cstring>

namespace reflet {

namespace {

gpu::ComputePass recordPass(gpu::PassList& f, const RecordRayInputs& in, const RecordRayParams& params,
                            const char* name, const char* shader) {
    gpu::ComputePass pass = f.compute(name, shader);
    pass.read("depth", in.g.depth)
        .read("normal", in.g.normal)
        .read("geometricNormal", in.g.geometricNormal)
        .read("backDepth", in.backDepth ? in.backDepth : in.g.depth)
        .read("pyramid", in.pyramid ? in.pyramid : makePyramid(f, in.g.depth, in.backDepth))
        .params(params);
    return pass;
}

}  // namespace

gpu::Readback recordRay(gpu::PassList& f, const RecordRayInputs& in, const ViewParams& view,
                        const TraceScreenSettings& settings, uvec2 pixel) {
    const gpu::Image record =
        f.image("ray_record", VK_FORMAT_R32G32B32A32_SFLOAT, uvec2(recordHead + recordedSteps, 1));
    recordPass(f, in, {view, settings, pixel, in.backDepth ? 1U : 0U, in.certainNext ? 1U : 0U}, "record_ray",
               "record_ray.comp")
        .write("record", record)
        .dispatch(1);
    return f.readback(record);
}

gpu::Readback recordHemisphere(gpu::PassList& f, const RecordRayInputs& in, const ViewParams& view,
                               const TraceScreenSettings& settings, uvec2 pixel) {
    const gpu::Image record =
        f.image("hemisphere_record", VK_FORMAT_R32G32B32A32_SFLOAT, uvec2(2 * recordedSamples, 1));
    recordPass(f, in, {view, settings, pixel, in.backDepth ? 1U : 0U, in.certainNext ? 1U : 0U}, "record_hemisphere",
               "record_hemisphere.comp")
        .write("record", record)
        .dispatch(recordedSamples);
    return f.readback(record);
}

std::vector<RecordedSample> recordedHemisphere(const gpu::Recorder& f, gpu::Readback readback) {
    std::vector<vec4> texels(size_t(2) * recordedSamples);
    std::memcpy(texels.data(), f.bytes(readback).data(), texels.size() * sizeof(vec4));
    std::vector<RecordedSample> samples;
    for (size_t i = 0; i < texels.size(); i += 2) {
        const vec4& end = texels[i + 1];
        samples.push_back({vec3(texels[i]), texels[i].w, end.x != 0.0F, uvec2(end.y, end.z)});
    }
    return samples;
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
    ray.unseen = texels[1].w != 0.0F;
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
