// The effects of the C API but lobes: checks, and what it hands out.
#include "api/calls.h"
#include "api/frame.h"

#include <algorithm>
#include <cmath>

namespace reflet::api {

namespace {

constexpr float realSun = 0.0093F;  // radians

template <class T>
void checkOut(T* out, const char* name) {
    if (out == nullptr) {
        failArgument("{}: is NULL", name);
    }
}

// Effects with a history take one result of each frame.
void checkOnce(bool recorded, const char* call) {
    if (recorded) {
        failArgument("view: {} was called in this frame already, and keeps one history; use a view of its own for more",
                     call);
    }
}

mat4 cascadeMatrix(const RefletSunShadow& sun, uint32_t i) {
    mat4 m;
    for (int k = 0; k < 16; ++k) {
        const float value = sun.worldToClip[i][k];
        if (!std::isfinite(value)) {
            failArgument("RefletSunShadow.worldToClip[{}][{}]: is not finite", i, k);
        }
        m[k / 4][k % 4] = value;
    }
    if (m[0][3] != 0.0F || m[1][3] != 0.0F || m[2][3] != 0.0F || m[3][3] != 1.0F) {
        failArgument("RefletSunShadow.worldToClip[{}]: is not orthographic; its last row must be (0, 0, 0, 1)", i);
    }
    for (int column = 0; column < 4; ++column) {
        vec4& c = m[column];
        c.y = sun.clipYUp != 0 ? -c.y : c.y;
        c.z = sun.depthKind == REFLET_DEPTH_STANDARD ? c.w - c.z : c.z;
    }
    return m;
}

// One cascade's map. side: texels.
ShadowMapParams mapParams(const mat4& worldToShadow, const vec3& toSun, float side, uint32_t i) {
    const mat4 rows = glm::transpose(worldToShadow);
    const float across = std::min(glm::length(vec3(rows[0])), glm::length(vec3(rows[1])));
    const float along = glm::length(vec3(rows[2]));
    if (!(across > 0.0F && along > 0.0F)) {
        failArgument("RefletSunShadow.worldToClip[{}]: has a row of zeros; matrices are column-major", i);
    }
    return {worldToShadow, toSun, 2.0F / (across * side), 1.0F / along};
}

// Reversed depth rises toward the sun. How far a map may lean is the host's business.
void checkSide(const RefletSunShadow& sun, const mat4& worldToShadow, const vec3& toSun, uint32_t i) {
    const vec3 rise(glm::transpose(worldToShadow)[2]);
    if (glm::dot(rise, toSun) > -0.01F * glm::length(rise)) {
        return;
    }
    const bool reversed = sun.depthKind == REFLET_DEPTH_REVERSED;
    failArgument(
        "RefletSunShadow.depthKind: is {}, and with worldToClip[{}] depth {} toward the sun; depthKind, the matrix or "
        "toSun (from surfaces to the sun) is wrong",
        reversed ? "REFLET_DEPTH_REVERSED" : "REFLET_DEPTH_STANDARD", i, reversed ? "falls" : "rises");
}

SunInputs sunInputs(const RefletSunShadow& sun, const Settings& settings) {
    SunInputs in;
    if (sun.cascades < 1 || sun.cascades > maxCascades) {
        failArgument("RefletSunShadow.cascades: is {}; must be 1 to {}", sun.cascades, maxCascades);
    }
    const vec3 toSun(sun.toSun[0], sun.toSun[1], sun.toSun[2]);
    if (!(glm::length(toSun) > 0.0F) || !std::isfinite(glm::length(toSun))) {
        failArgument("RefletSunShadow.toSun: is ({}, {}, {}); must be a direction", toSun.x, toSun.y, toSun.z);
    }
    if (sun.map.width != sun.map.height) {
        failArgument("RefletSunShadow.map: is {}x{}; must be square", sun.map.width, sun.map.height);
    }
    if (!(sun.angularDiameter >= 0.0F && sun.angularDiameter < 3.0F)) {
        failArgument("RefletSunShadow.angularDiameter: is {}; must be 0 to 3 radians", sun.angularDiameter);
    }
    checkBoolean(sun.clipYUp, "RefletSunShadow.clipYUp");
    checkBoolean(sun.contactShadows, "RefletSunShadow.contactShadows");
    checkDepthKind(sun.depthKind, "RefletSunShadow.depthKind");
    in.toSun = glm::normalize(toSun);
    in.reversed = sun.depthKind == REFLET_DEPTH_REVERSED;
    in.contact = sun.contactShadows != 0;
    in.slope = lighting::sunSlope(sun.angularDiameter > 0.0F ? sun.angularDiameter : realSun);
    in.sun.count = sun.cascades;
    float start = 0.0F;
    for (uint32_t i = 0; i < sun.cascades; ++i) {
        in.sun.maps[i] = mapParams(cascadeMatrix(sun, i), in.toSun, static_cast<float>(sun.map.width), i);
        checkSide(sun, in.sun.maps[i].worldToShadow, in.toSun, i);
        const bool last = i + 1 == sun.cascades;
        const float split = sun.cascadeSplits[i];
        if (!last && !(split > start && std::isfinite(split))) {
            failArgument("RefletSunShadow.cascadeSplits[{}]: is {}; splits must rise from above 0", i, split);
        }
        const float end = last && !(split > start) ? std::numeric_limits<float>::max() : split;
        in.sun.ends[i] = end;
        in.sun.blends[i] = lighting::cascadeBlend(settings.shadow, start, end);
        start = end;
    }
    return in;
}

// The image of an argument that may be NULL, which stands for `otherwise`.
gpu::Image hostImageOf(const RefletImage* given, const char* name, const char* otherwise, HostImages& host,
                       const Rectangle& read) {
    if (given == nullptr) {
        return {};
    }
    if (given->image == VK_NULL_HANDLE) {
        failArgument("{}.image: is VK_NULL_HANDLE; pass NULL for {}", name, otherwise);
    }
    checkImage(*given, name, read, 3);
    const gpu::Image image = host.add(*given, read.size);
    host.acquire();
    return image;
}

Lens lensOf(const RefletLens& lens) {
    if (!(lens.apertureRadius >= 0.0F) || !std::isfinite(lens.apertureRadius)) {
        failArgument("RefletLens.apertureRadius: is {}; must be finite and at least 0", lens.apertureRadius);
    }
    if (!(lens.focusDistance > 0.0F) || !std::isfinite(lens.focusDistance)) {
        failArgument("RefletLens.focusDistance: is {}; must be finite and above 0", lens.focusDistance);
    }
    if (lens.blades != 0 && (lens.blades < 3 || lens.blades > 16)) {
        failArgument("RefletLens.blades: is {}; must be 0, or 3 to 16", lens.blades);
    }
    if (!std::isfinite(lens.bladeRotation)) {
        failArgument("RefletLens.bladeRotation: is {}; must be finite", lens.bladeRotation);
    }
    return {lens.apertureRadius, lens.focusDistance, lens.blades, lens.bladeRotation};
}

gpu::Image colorOf(const RefletImage* color, HostImages& host, const Rectangle& read) {
    return hostImageOf(color, "color", "the result of the effect before", host, read);
}

}  // namespace

}  // namespace reflet::api

using namespace reflet;
using namespace reflet::api;

RefletResult refletSunShadow(RefletView view, RefletSettings settings, const RefletSunShadow* sun,
                             RefletImage* visibility) {
    return inFrame(view, settings, [&](Frame& frame, const Settings& values) {
        checkOut(visibility, "visibility");
        checkOnce(static_cast<bool>(frame.sunVisibility), "refletSunShadow");
        const RefletSunShadow given = adopted(sun, "RefletSunShadow");
        if (given.map.image == VK_NULL_HANDLE) {
            failArgument("RefletSunShadow.map.image: is VK_NULL_HANDLE, and is required");
        }
        checkImage(given.map, "RefletSunShadow.map", {}, depthChannel);
        SunInputs in = sunInputs(given, values);
        HostImages host(*view);
        in.map = host.add(given.map, uvec2(0), given.cascades);
        host.acquire();
        *visibility = resultOf(recordSunShadow(*view, frame, values, in));
    });
}

RefletResult refletContactShadows(RefletView view, RefletSettings settings, const RefletContactLight* light,
                                  RefletImage* visibility) {
    return inFrame(view, settings, [&](Frame& frame, const Settings& values) {
        checkOut(visibility, "visibility");
        const RefletContactLight given = adopted(light, "RefletContactLight");
        checkBoolean(given.isPositional, "RefletContactLight.isPositional");
        const vec3 at(given.light[0], given.light[1], given.light[2]);
        const float length = glm::length(at);
        if (!std::isfinite(length) || (given.isPositional == 0 && !(length > 1e-12F))) {
            failArgument(
                "RefletContactLight.light: is ({}, {}, {}); must be a direction, or a position with isPositional", at.x,
                at.y, at.z);
        }
        *visibility = resultOf(recordContactShadows(
            *view, frame, values, given.isPositional != 0 ? vec4(at, 1.0F) : vec4(at / length, 0.0F)));
    });
}

RefletResult refletAmbientOcclusion(RefletView view, RefletSettings settings, RefletImage* occlusion) {
    return inFrame(view, settings, [&](Frame& frame, const Settings& values) {
        checkOut(occlusion, "occlusion");
        checkOnce(static_cast<bool>(frame.ambientOcclusion), "refletAmbientOcclusion");
        *occlusion = resultOf(recordAmbientOcclusion(*view, frame, values));
    });
}

RefletResult refletComposite(RefletView view, RefletSettings settings, const RefletImage* light,
                             RefletComposite* composite) {
    return inFrame(view, settings, [&](Frame& frame, const Settings& values) {
        checkNonePending(frame);
        const RefletComposite given = adopted(composite, "RefletComposite");
        HostImages host(*view);
        const gpu::Image image =
            hostImageOf(light, "light", "the light that the lobes were given", host, {frame.size, frame.inLarger});
        const lighting::Light sum = recordComposite(*view, frame, values, image);
        RefletComposite result{};
        result.structSize = given.structSize;
        result.lit = resultOf(sum.lit);
        result.indirectDiffuse = resultOf(sum.indirectDiffuse);
        result.indirectSpecular = resultOf(sum.indirectSpecular);
        std::memcpy(composite, &result, given.structSize);
    });
}

RefletResult refletTemporal(RefletView view, RefletSettings settings, const RefletImage* color,
                            RefletImage* antialiased) {
    return inFrame(view, settings, [&](Frame& frame, const Settings& values) {
        checkOut(antialiased, "antialiased");
        checkOnce(static_cast<bool>(frame.antialiased), "refletTemporal");
        HostImages host(*view);
        *antialiased =
            resultOf(recordTemporal(*view, frame, values, colorOf(color, host, {frame.size, frame.inLarger})));
    });
}

RefletResult refletDepthOfField(RefletView view, RefletSettings settings, const RefletLens* lens,
                                const RefletImage* color, RefletImage* blurred) {
    return inFrame(view, settings, [&](Frame& frame, const Settings& values) {
        checkOut(blurred, "blurred");
        checkOnce(static_cast<bool>(frame.defocused), "refletDepthOfField");
        const Lens thin = lensOf(adopted(lens, "RefletLens"));
        HostImages host(*view);
        *blurred = resultOf(recordDepthOfField(*view, frame, values, thin,
                                               colorOf(color, host, {outputSizeOf(*view), frame.inLarger})));
    });
}

RefletResult refletMotionBlur(RefletView view, RefletSettings settings, const RefletImage* color,
                              RefletImage* blurred) {
    return inFrame(view, settings, [&](Frame& frame, const Settings& values) {
        checkOut(blurred, "blurred");
        HostImages host(*view);
        *blurred = resultOf(
            recordMotionBlur(*view, frame, values, colorOf(color, host, {outputSizeOf(*view), frame.inLarger})));
    });
}
