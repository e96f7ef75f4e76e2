// The host's G-buffer: checks, and as the stages take it.
#include "api/calls.h"
#include "api/camera.h"
#include "api/frame.h"

namespace reflet::api {

namespace {

void checkKinds(const RefletGBuffer& g) {
    const auto check = [](const char* name, auto value, auto last) {
        if (value < 0 || value > last) {
            failArgument("gbuffer.{}: is {}; known values are 0 to {}", name, static_cast<int>(value),
                         static_cast<int>(last));
        }
    };
    checkDepthKind(g.depthKind, "gbuffer.depthKind");
    check("normalKind", static_cast<int>(g.normalKind), static_cast<int>(REFLET_NORMAL_VECTOR_UNORM));
    check("roughnessKind", static_cast<int>(g.roughnessKind), static_cast<int>(REFLET_ROUGHNESS_SMOOTHNESS));
    check("baseColorKind", static_cast<int>(g.baseColorKind), static_cast<int>(REFLET_COLOR_SRGB));
    check("motionKind", static_cast<int>(g.motionKind), static_cast<int>(REFLET_MOTION_PIXELS));
    check("roughnessChannel", static_cast<int64_t>(g.roughnessChannel), int64_t(3));
    check("metallicChannel", static_cast<int64_t>(g.metallicChannel), int64_t(3));
    check("excludedChannel", static_cast<int64_t>(g.excludedChannel), int64_t(3));
    check("unlitChannel", static_cast<int64_t>(g.unlitChannel), int64_t(3));
    check("reactiveChannel", static_cast<int64_t>(g.reactiveChannel), int64_t(3));
    checkBoolean(g.normalsInViewSpace, "gbuffer.normalsInViewSpace");
    checkBoolean(g.motionIncludesJitter, "gbuffer.motionIncludesJitter");
}

}  // namespace

void checkGBuffer(const RefletGBuffer& g, const Rectangle& read) {
    checkKinds(g);
    struct Field {
        const char* name;
        const RefletImage* image;
        uint32_t channels;
    };
    const bool octahedral =
        g.normalKind == REFLET_NORMAL_OCTAHEDRAL_SNORM || g.normalKind == REFLET_NORMAL_OCTAHEDRAL_UNORM;
    const uint32_t normalChannels = octahedral ? 2 : 3;
    const Field fields[] = {{"gbuffer.depth", &g.depth, depthChannel},
                            {"gbuffer.normal", &g.normal, normalChannels},
                            {"gbuffer.roughness", &g.roughness, g.roughnessChannel + 1},
                            {"gbuffer.geometricNormal", &g.geometricNormal, normalChannels},
                            {"gbuffer.metallic", &g.metallic, g.metallicChannel + 1},
                            {"gbuffer.baseColor", &g.baseColor, 3},
                            {"gbuffer.f0", &g.f0, 3},
                            {"gbuffer.motion", &g.motion, 2},
                            {"gbuffer.backDepth", &g.backDepth, depthChannel},
                            {"gbuffer.excluded", &g.excluded, g.excludedChannel + 1},
                            {"gbuffer.unlit", &g.unlit, g.unlitChannel + 1},
                            {"gbuffer.reactive", &g.reactive, g.reactiveChannel + 1}};
    for (const auto& [name, image, channels] : fields) {
        const bool required = image == &g.depth || image == &g.normal;
        if (required && image->image == VK_NULL_HANDLE) {
            failArgument("{}.image: is VK_NULL_HANDLE, and is required", name);
        }
        if (image->image != VK_NULL_HANDLE) {
            checkImage(*image, name, read, channels);
        }
    }
}

HostSurfaces hostSurfaces(const RefletGBuffer& g, const std::function<gpu::Image(const RefletImage&)>& adopt) {
    HostSurfaces host;
    host.depth = adopt(g.depth);
    host.reversed = g.depthKind == REFLET_DEPTH_REVERSED;
    host.normal = adopt(g.normal);
    host.normalKind = static_cast<uint32_t>(g.normalKind);
    host.geometricNormal = adopt(g.geometricNormal);
    host.roughness = adopt(g.roughness);
    host.roughnessChannel = g.roughnessChannel;
    host.roughnessKind = static_cast<uint32_t>(g.roughnessKind);
    host.metallic = adopt(g.metallic);
    host.metallicChannel = g.metallicChannel;
    host.baseColor = adopt(g.baseColor);
    host.baseColorIsSrgb = g.baseColorKind == REFLET_COLOR_SRGB;
    host.f0 = adopt(g.f0);
    host.motion = adopt(g.motion);
    host.backDepth = adopt(g.backDepth);
    host.excluded = adopt(g.excluded);
    host.excludedChannel = g.excludedChannel;
    host.unlit = adopt(g.unlit);
    host.unlitChannel = g.unlitChannel;
    host.reactive = adopt(g.reactive);
    host.reactiveChannel = g.reactiveChannel;
    return host;
}

}  // namespace reflet::api
