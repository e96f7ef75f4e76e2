// The lobes of the C API, and a host's own source of their rays: checks, and what it hands out.
#include "api/calls.h"
#include "api/frame.h"
#include "api/light_sources.h"

#include <cmath>

namespace reflet::api {

namespace {

EnvironmentInputs environmentInputs(const RefletEnvironment& environment, HostImages& host) {
    EnvironmentInputs in;
    in.image = host.add(environment.image, uvec2(0));
    in.from = environment.image.view;
    in.revision = environment.revision;
    vec3 factor(environment.factor[0], environment.factor[1], environment.factor[2]);
    if (in.image && factor == vec3(0.0F)) {
        factor = vec3(1.0F);
    }
    const vec3 up(environment.worldUp[0], environment.worldUp[1], environment.worldUp[2]);
    in.params = lighting::environmentParams(factor, environment.rotation,
                                            up == vec3(0.0F) ? vec3(0.0F, 1.0F, 0.0F) : glm::normalize(up));
    return in;
}

void checkEnvironment(const RefletEnvironment& environment, float preExposure) {
    for (int i = 0; i < 3; ++i) {
        const float most = 65504.0F / preExposure;
        if (!(environment.factor[i] >= 0.0F && environment.factor[i] <= most)) {
            failArgument(
                "RefletEnvironment.factor[{}]: is {}; must be 0 to {} (65504 / preExposure), as images are half floats",
                i, environment.factor[i], most);
        }
    }
    if (!std::isfinite(environment.rotation)) {
        failArgument("RefletEnvironment.rotation: is not finite");
    }
    const vec3 up(environment.worldUp[0], environment.worldUp[1], environment.worldUp[2]);
    if (!std::isfinite(glm::dot(up, up)) || (up != vec3(0.0F) && !(glm::dot(up, up) > 1e-12F))) {
        failArgument("RefletEnvironment.worldUp: is ({}, {}, {}); must be a direction, or all 0 for +Y", up.x, up.y,
                     up.z);
    }
    if (environment.image.image != VK_NULL_HANDLE) {
        checkImage(environment.image, "RefletEnvironment.image", {}, 3);
    }
}

RefletLobe lobeOf(const LobeLight& light, size_t structSize) {
    RefletLobe out{};
    out.structSize = structSize;
    out.radiance = resultOf(light.radiance);
    out.confidence = resultOf(light.source);
    out.downsample = light.from.scale;
    return out;
}

// What rays find, as a call was given it. The images are there until `host` ends.
struct LightInputs {
    gpu::Image light;
    EnvironmentInputs environment;
    SourceInputs sources;

    [[nodiscard]] LobeInputsOfHost all() const { return {light, environment, sources}; }
};

LightInputs lightInputs(const RefletView_T& view, const Frame& frame, const RefletIndirectLight* light,
                        HostImages& host) {
    const RefletIndirectLight given =
        adopted(light, "RefletIndirectLight", offsetof(RefletIndirectLight, specularFallback));
    if (given.light.image == VK_NULL_HANDLE) {
        failArgument("RefletIndirectLight.light.image: is VK_NULL_HANDLE, and is required");
    }
    checkImage(given.light, "RefletIndirectLight.light", {frame.size, frame.inLarger}, 3);
    const RefletEnvironment around = given.environment != nullptr
                                         ? adopted(given.environment, "RefletIndirectLight.environment")
                                         : RefletEnvironment{};
    checkEnvironment(around, frame.preExposure);
    const LightInputs in{host.add(given.light, frame.size), environmentInputs(around, host),
                         sourceInputs(view, frame, given, host)};
    host.acquire();
    return in;
}

// Its history takes one result of each frame.
void checkLobeIsNew(const Frame& frame, uint32_t lobe) {
    checkNonePending(frame);
    if ((lobe == lobeDiffuse ? frame.diffuse : frame.specular).has_value()) {
        failArgument(
            "view: {} has a result in this frame already, and keeps one history; use a view of its own for more",
            lobeName(lobe));
    }
}

RefletResult traceLobeOf(RefletView view, RefletSettings settings, const RefletIndirectLight* light, RefletLobe* lobe,
                         uint32_t kind) {
    return inFrame(view, settings, [&](Frame& frame, const Settings& values) {
        checkLobeIsNew(frame, kind);
        const RefletLobe asked = adopted<RefletLobe>(lobe, "lobe");
        HostImages host(*view);
        const LightInputs in = lightInputs(*view, frame, light, host);
        const RefletLobe out = lobeOf(recordLobe(*view, frame, values, kind, in.all()), asked.structSize);
        std::memcpy(lobe, &out, out.structSize);
    });
}

uint32_t lobeOfKind(RefletLobeKind kind) {
    if (kind != REFLET_LOBE_DIFFUSE && kind != REFLET_LOBE_SPECULAR) {
        failArgument("kind: is {}; must be REFLET_LOBE_DIFFUSE or REFLET_LOBE_SPECULAR", static_cast<int>(kind));
    }
    return kind == REFLET_LOBE_DIFFUSE ? lobeDiffuse : lobeSpecular;
}

RefletBuffer resultOf(const gpu::BufferView& buffer) {
    RefletBuffer result{};
    result.buffer = buffer.state->buffer;
    result.size = buffer.size;
    result.stages = buffer.state->access.writeStages;
    result.access = buffer.state->access.writeAccess;
    return result;
}

// The host's answers become visible to compute passes. With stages 0 these still wait for whatever the host's commands
// read of the rays: later passes of the frame get the memory.
void acquireAnswers(RefletView_T& view, const RefletRayAnswers& given, const gpu::BufferView& answers) {
    VkBufferMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2};
    barrier.srcStageMask = given.stages != 0 ? given.stages : VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = given.access;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.buffer = answers.state->buffer;
    barrier.size = VK_WHOLE_SIZE;
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.bufferMemoryBarrierCount = 1;
    info.pBufferMemoryBarriers = &barrier;
    view.owner.gpu->vk.vkCmdPipelineBarrier2(view.commands, &info);
}

void checkPending(const Frame& frame, uint32_t lobe) {
    if (!frame.pending) {
        failArgument("kind: no rays wait for answers; call refletMissedRays first, and refletAnswerRays once");
    }
    if (frame.pending->lobe != lobe) {
        failArgument("kind: is {}; the rays of refletMissedRays are of {}", lobeName(lobe),
                     lobeName(frame.pending->lobe));
    }
}

}  // namespace

const char* lobeName(uint32_t lobe) {
    return lobe == lobeDiffuse ? "REFLET_LOBE_DIFFUSE" : "REFLET_LOBE_SPECULAR";
}

void checkNonePending(const Frame& frame) {
    if (frame.pending) {
        failArgument("view: rays of refletMissedRays wait for answers; call refletAnswerRays with {} first",
                     lobeName(frame.pending->lobe));
    }
}

}  // namespace reflet::api

using namespace reflet;
using namespace reflet::api;

RefletResult refletDiffuseGi(RefletView view, RefletSettings settings, const RefletIndirectLight* light,
                             RefletLobe* lobe) {
    return traceLobeOf(view, settings, light, lobe, lobeDiffuse);
}

RefletResult refletReflections(RefletView view, RefletSettings settings, const RefletIndirectLight* light,
                               RefletLobe* lobe) {
    return traceLobeOf(view, settings, light, lobe, lobeSpecular);
}

RefletResult refletDenoise(RefletView view, RefletSettings settings, RefletLobeKind kind, const RefletImage* noisy,
                           RefletLobe* lobe) {
    return inFrame(view, settings, [&](Frame& frame, const Settings& values) {
        const uint32_t which = lobeOfKind(kind);
        checkLobeIsNew(frame, which);
        const RefletLobe asked = adopted<RefletLobe>(lobe, "lobe");
        if (noisy == nullptr || noisy->image == VK_NULL_HANDLE) {
            failArgument("noisy: is NULL");
        }
        checkImage(*noisy, "noisy", {frame.size, frame.inLarger}, 4);
        HostImages host(*view);
        const gpu::Image image = host.add(*noisy, frame.size);
        host.acquire();
        RefletLobe out = lobeOf(recordDenoise(*view, frame, values, which, image), asked.structSize);
        out.confidence = {};
        std::memcpy(lobe, &out, out.structSize);
    });
}

RefletResult refletMissedRays(RefletView view, RefletSettings settings, RefletLobeKind kind,
                              const RefletIndirectLight* light, RefletMissedRays* missed) {
    return inFrame(view, settings, [&](Frame& frame, const Settings& values) {
        const uint32_t lobe = lobeOfKind(kind);
        checkLobeIsNew(frame, lobe);
        const RefletMissedRays asked = adopted<RefletMissedRays>(missed, "RefletMissedRays");
        HostImages host(*view);
        const LightInputs in = lightInputs(*view, frame, light, host);
        const MissedRays rays = recordMissedRays(*view, frame, values, lobe, in.all());
        RefletMissedRays out{};
        out.structSize = asked.structSize;
        out.rays = resultOf(rays.rays);
        out.answers = resultOf(rays.answers);
        out.capacity = rays.capacity;
        std::memcpy(missed, &out, out.structSize);
    });
}

RefletResult refletAnswerRays(RefletView view, RefletSettings settings, RefletLobeKind kind,
                              const RefletRayAnswers* answers, RefletLobe* lobe) {
    return inFrame(view, settings, [&](Frame& frame, const Settings& values) {
        checkPending(frame, lobeOfKind(kind));
        const RefletRayAnswers given = adopted(answers, "RefletRayAnswers");
        const RefletLobe asked = adopted<RefletLobe>(lobe, "lobe");
        if (given.stages == 0 && given.access != 0) {
            failArgument("RefletRayAnswers.stages: is 0, and access is not; name the stages that wrote the answers");
        }
        acquireAnswers(*view, given, frame.pending->missed.answers);
        const RefletLobe out = lobeOf(recordAnswers(*view, frame, values), asked.structSize);
        std::memcpy(lobe, &out, out.structSize);
    });
}
