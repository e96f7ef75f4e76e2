// Light that a host has itself: checks, and as the stages take it.
#include "api/light_sources.h"

#include "api/calls.h"
#include "api/camera.h"

#include <glm/gtc/constants.hpp>

#include <bit>
#include <cmath>
#include <span>

namespace reflet::api {

namespace {

vec3 finiteVector(const float (&v)[3], const std::string& name) {
    for (const float value : v) {
        if (!std::isfinite(value)) {
            failArgument("{}: is ({}, {}, {}); must be finite", name, v[0], v[1], v[2]);
        }
    }
    return {v[0], v[1], v[2]};
}

vec3 halfExtents(const float (&v)[3], const std::string& name) {
    const vec3 half = finiteVector(v, name);
    if (!(half.x > 0.0F && half.y > 0.0F && half.z > 0.0F)) {
        failArgument("{}: is ({}, {}, {}); must be above 0, in metres", name, v[0], v[1], v[2]);
    }
    return half;
}

void checkCube(const RefletImage& image, const std::string& name, uint32_t channels) {
    checkImage(image, name.c_str(), {}, channels);
    if (image.width != image.height) {
        failArgument("{}.width, height: are {}x{}; faces of a cube map are square", name, image.width, image.height);
    }
}

float irradianceScaleOf(RefletIrradianceKind kind, const std::string& name) {
    if (kind != REFLET_IRRADIANCE && kind != REFLET_IRRADIANCE_OVER_PI) {
        failArgument("{}: is {}; known values are 0 and 1", name, static_cast<int>(kind));
    }
    return kind == REFLET_IRRADIANCE ? glm::one_over_pi<float>() : 1.0F;
}

ProbeParallax parallaxOf(const RefletProbe& probe, const std::string& name) {
    switch (probe.parallax) {
        case REFLET_PARALLAX_BOX:
            return ProbeParallax::box;
        case REFLET_PARALLAX_NONE:
            return ProbeParallax::none;
        case REFLET_PARALLAX_DEPTH:
            if (probe.distance.image == VK_NULL_HANDLE) {
                failArgument("{}.distance.image: is VK_NULL_HANDLE, and REFLET_PARALLAX_DEPTH needs it", name);
            }
            return ProbeParallax::depth;
        default:
            failArgument("{}.parallax: is {}; known values are 0 to 2", name, static_cast<int>(probe.parallax));
    }
}

ProbeParams probeParams(const RefletProbe& probe, const std::string& name) {
    ProbeParams params{};
    params.position = finiteVector(probe.position, name + ".position");
    const vec3 center = finiteVector(probe.boxCenter, name + ".boxCenter");
    const vec3 half = halfExtents(probe.boxHalfExtents, name + ".boxHalfExtents");
    params.boxMin = center - half;
    params.boxMax = center + half;
    params.parallaxMin = params.boxMin;
    params.parallaxMax = params.boxMax;
    const auto& around = probe.parallaxHalfExtents;
    if (around[0] != 0.0F || around[1] != 0.0F || around[2] != 0.0F) {
        const vec3 middle = finiteVector(probe.parallaxCenter, name + ".parallaxCenter");
        const vec3 reach = halfExtents(around, name + ".parallaxHalfExtents");
        params.parallaxMin = middle - reach;
        params.parallaxMax = middle + reach;
    }
    if (!(probe.blend >= 0.0F) || !std::isfinite(probe.blend)) {
        failArgument("{}.blend: is {}; must be finite and at least 0 metres", name, probe.blend);
    }
    params.blend = probe.blend;
    if (!(probe.factor >= 0.0F) || !std::isfinite(probe.factor)) {
        failArgument("{}.factor: is {}; must be finite and above 0, or 0 for 1", name, probe.factor);
    }
    params.radianceScale = probe.factor > 0.0F ? probe.factor : 1.0F;
    params.parallax = static_cast<uint32_t>(parallaxOf(probe, name));
    return params;
}

std::array<vec4, irradianceCoefficients> harmonicsOf(const RefletProbe& probe, float scale, const std::string& name) {
    constexpr float one = 3.5449077F;  // of the constant function 1
    std::array<vec4, irradianceCoefficients> out{};
    for (size_t i = 0; i < irradianceCoefficients; ++i) {
        const float* const c = probe.sphericalHarmonics + 3 * i;
        if (!std::isfinite(c[0]) || !std::isfinite(c[1]) || !std::isfinite(c[2])) {
            failArgument("{}.sphericalHarmonics[{}]: is not finite", name, 3 * i);
        }
        out.at(i) = scale * vec4(c[0], c[1], c[2], 0.0F);
    }
    out[0].w = one;
    return out;
}

HostProbe probeOf(const RefletProbe& probe, const std::string& name, HostImages& host) {
    HostProbe out{};
    out.params = probeParams(probe, name);
    if (probe.radiance.image == VK_NULL_HANDLE) {
        failArgument("{}.radiance.image: is VK_NULL_HANDLE, and is required", name);
    }
    checkBoolean(probe.alphaIsCoverage, (name + ".alphaIsCoverage").c_str());
    checkCube(probe.radiance, name + ".radiance", probe.alphaIsCoverage != 0 ? 4 : 3);
    const auto most = static_cast<uint32_t>(std::bit_width(probe.radiance.width));
    if (probe.radianceLevels > most) {
        failArgument("{}.radianceLevels: is {}; a cube map of side {} has at most {}", name, probe.radianceLevels,
                     probe.radiance.width, most);
    }
    out.levels = std::max(probe.radianceLevels, 1U);
    out.hasCoverage = probe.alphaIsCoverage != 0;
    out.radiance = host.add(probe.radiance, uvec2(0), 6, out.levels);
    if (probe.distance.image != VK_NULL_HANDLE) {
        checkCube(probe.distance, name + ".distance", 1);
        out.distance = host.add(probe.distance, uvec2(0), 6);
    }
    out.irradianceScale = irradianceScaleOf(probe.irradianceKind, name + ".irradianceKind");
    if (probe.irradiance.image != VK_NULL_HANDLE) {
        if (probe.sphericalHarmonics != nullptr) {
            failArgument("{}.sphericalHarmonics: is given, and so is irradiance; give one of them", name);
        }
        checkCube(probe.irradiance, name + ".irradiance", 3);
        out.irradiance = host.add(probe.irradiance, uvec2(0), 6);
    }
    if (probe.sphericalHarmonics != nullptr) {
        out.harmonics = harmonicsOf(probe, out.irradianceScale, name);
    }
    return out;
}

template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto more = std::as_bytes(std::span(&value, 1));
    bytes.insert(bytes.end(), more.begin(), more.end());
}

// What the maps are made of; not where they shine.
void appendKey(std::vector<std::byte>& key, const RefletProbe& given, const HostProbe& probe) {
    append(key, given.revision);
    append(key, given.radiance.view);
    append(key, given.radiance.width);
    append(key, probe.levels);
    append(key, given.alphaIsCoverage);
    append(key, given.distance.view);
    append(key, given.irradiance.view);
    append(key, probe.irradianceScale);
    if (probe.harmonics) {
        append(key, *probe.harmonics);
    }
}

void checkCounts(const RefletIndirectLight& light) {
    if (light.probeCount > REFLET_MAX_PROBES) {
        failArgument("RefletIndirectLight.probeCount: is {}; at most {}", light.probeCount, REFLET_MAX_PROBES);
    }
    if (light.probeCount > 0 && light.probes == nullptr) {
        failArgument("RefletIndirectLight.probes: is NULL, and probeCount is {}", light.probeCount);
    }
    if (light.planarViewCount > REFLET_MAX_PLANAR_VIEWS) {
        failArgument("RefletIndirectLight.planarViewCount: is {}; at most {}", light.planarViewCount,
                     REFLET_MAX_PLANAR_VIEWS);
    }
    if (light.planarViewCount > 0 && light.planarViews == nullptr) {
        failArgument("RefletIndirectLight.planarViews: is NULL, and planarViewCount is {}", light.planarViewCount);
    }
    checkBoolean(light.planarViewsAfterScreen, "RefletIndirectLight.planarViewsAfterScreen");
}

void addProbes(SourceInputs& in, const RefletIndirectLight& light, HostImages& host) {
    for (uint32_t i = 0; i < light.probeCount; ++i) {
        const std::string name = fmt::format("RefletIndirectLight.probes[{}]", i);
        const RefletProbe probe = probeAt(light, i);
        in.probes.push_back(probeOf(probe, name, host));
        appendKey(in.probeKey, probe, in.probes.back());
    }
}

// The camera of a planar view; messages name it.
ViewParams planarCamera(const RefletPlanarView& planar, const std::string& name) {
    RefletFrameInfo camera{};
    std::memcpy(camera.worldToView, planar.worldToView, sizeof camera.worldToView);
    std::memcpy(camera.viewToClip, planar.viewToClip, sizeof camera.viewToClip);
    camera.clipYUp = planar.clipYUp;
    camera.clipDepthFromMinusOne = planar.clipDepthFromMinusOne;
    const uvec2 size(planar.color.width, planar.color.height);
    try {
        return viewParams(camera, planar.depthKind, size, size);
    } catch (const Failure& failure) {
        std::string text = failure.what();
        for (const std::string_view other : {"RefletFrameInfo", "RefletGBuffer"}) {
            for (size_t at = text.find(other); at != std::string::npos; at = text.find(other)) {
                text.replace(at, other.size(), name);
            }
        }
        throw Failure(failure.result(), text);
    }
}

lighting::HostPlanarView planarOf(const RefletPlanarView& planar, const std::string& name, HostImages& host) {
    for (const auto& [image, field, channels] :
         {std::tuple(&planar.color, ".color", 3U), std::tuple(&planar.depth, ".depth", depthChannel)}) {
        if (image->image == VK_NULL_HANDLE) {
            failArgument("{}{}.image: is VK_NULL_HANDLE, and is required", name, field);
        }
        checkImage(*image, (name + field).c_str(), {}, channels);
    }
    if (planar.depth.width != planar.color.width || planar.depth.height != planar.color.height) {
        failArgument("{}.depth.width, height: are {}x{}, and color is {}x{}; both must be the same", name,
                     planar.depth.width, planar.depth.height, planar.color.width, planar.color.height);
    }
    checkDepthKind(planar.depthKind, (name + ".depthKind").c_str());
    checkBoolean(planar.clipYUp, (name + ".clipYUp").c_str());
    checkBoolean(planar.clipDepthFromMinusOne, (name + ".clipDepthFromMinusOne").c_str());
    const vec4 plane(planar.plane[0], planar.plane[1], planar.plane[2], planar.plane[3]);
    const float length = glm::length(vec3(plane));
    if (!(std::abs(length - 1.0F) < 1e-3F) || !std::isfinite(plane.w)) {
        failArgument("{}.plane: is ({}, {}, {}, {}); the first three must be a unit normal, the fourth finite", name,
                     plane.x, plane.y, plane.z, plane.w);
    }
    if (!(planar.tolerance >= 0.0F) || !std::isfinite(planar.tolerance)) {
        failArgument("{}.tolerance: is {}; must be finite and at least 0 metres", name, planar.tolerance);
    }
    constexpr float usualTolerance = 1e-3F;
    lighting::HostPlanarView out;
    out.view = planarCamera(planar, name);
    out.color = host.add(planar.color, uvec2(0));
    out.depth = host.add(planar.depth, uvec2(0));
    out.reversed = planar.depthKind == REFLET_DEPTH_REVERSED;
    out.plane = plane;
    out.tolerance = planar.tolerance > 0.0F ? planar.tolerance : usualTolerance;
    return out;
}

void addPlanarViews(SourceInputs& in, const RefletIndirectLight& light, HostImages& host) {
    in.planarAfterScreen = light.planarViewsAfterScreen != 0;
    for (uint32_t i = 0; i < light.planarViewCount; ++i) {
        const std::string name = fmt::format("RefletIndirectLight.planarViews[{}]", i);
        const RefletPlanarView planar = adopted(elementOf(light.planarViews, i), name.c_str());
        in.planar.push_back(planarOf(planar, name, host));
    }
}

gpu::Image lightImage(const Frame& frame, const RefletImage& image, const char* name, HostImages& host) {
    if (image.image == VK_NULL_HANDLE) {
        return {};
    }
    checkImage(image, name, {frame.size, frame.inLarger}, 4);
    return host.add(image, frame.size);
}

}  // namespace

RefletProbe probeAt(const RefletIndirectLight& light, uint32_t i) {
    const std::string name = fmt::format("RefletIndirectLight.probes[{}]", i);
    return adopted(elementOf(light.probes, i), name.c_str());
}

RefletIndirectLight preparedLight(const RefletPrepareInfo& info) {
    if (info.light == nullptr) {
        return {};
    }
    const RefletIndirectLight light =
        adopted(info.light, "RefletPrepareInfo.light", offsetof(RefletIndirectLight, specularFallback));
    checkCounts(light);
    return light;
}

SourceInputs sourceInputs(const RefletView_T& view, const Frame& frame, const RefletIndirectLight& light,
                          HostImages& host) {
    checkCounts(light);
    SourceInputs in;
    in.specular = lightImage(frame, light.specularFallback, "RefletIndirectLight.specularFallback", host);
    in.irradiance = lightImage(frame, light.irradiance, "RefletIndirectLight.irradiance", host);
    in.irradianceScale = irradianceScaleOf(light.irradianceKind, "RefletIndirectLight.irradianceKind");
    addProbes(in, light, host);
    addPlanarViews(in, light, host);
    in.cache = light.radianceCache != nullptr ? heldCache(light.radianceCache, view) : nullptr;
    return in;
}

}  // namespace reflet::api
