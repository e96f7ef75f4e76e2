// Cascaded shadow maps of the sun: the view's depth range is split (Zhang, Sun, Xu and Lun, Parallel-split shadow maps
// for large-scale virtual environments, 2006), and each part has a map of the same resolution. Maps cover the parts'
// bounding spheres, whose size does not depend on camera motion, and move in whole texels, so that shadow edges do not
// shimmer.
#include "lighting/direct.h"
#include "renderer/draw_shadows/light_space.h"
#include "renderer/draw_shadows/shadow_maps.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

// Largest texels, in units of the finest shadows that the picture shows where surfaces are nearest: of a single map,
// and of cascades if that is too coarse.
constexpr float coarsestInOneMap = 4.0F;
constexpr float coarsestInCascades = 0.5F;

// Range to be covered by cascades: distances in front of the camera [m].
struct DepthRange {
    float first = 0.0F;  // near end of the scene
    float near = 0.0F;   // start of the logarithmic split
    float far = 0.0F;    // far end of the scene
};

vec3 middleOfView(const ViewParams& view) {
    const vec4 p = view.paddedClipToWorld * vec4(0, 0, 0.5F, 1);
    return vec3(p) / p.w;
}

// Distance of the view's corners from the camera's axis, per metre in front of the camera (orthographic: in metres). A
// view may be an off-centre crop of a wider one.
float cornerSlope(const ViewParams& view) {
    const float half = 0.5F * view.pixelAngle * glm::length(view.size);
    if (view.eye.w == 0.0F) {
        return half;
    }
    const vec3 toMiddle = middleOfView(view) - vec3(view.eye);
    const float ahead = glm::dot(vec3(view.viewPlane), toMiddle);
    const float aside = glm::length(toMiddle - vec3(view.viewPlane) * ahead) / ahead;
    return half + (aside > 1e-3F ? aside : 0.0F);  // less is rounding error, which would change with every rotation
}

// Camera rotation does not change these; translation changes them in steps.
DepthRange depthRangeOf(const ViewParams& view, const Aabb& scene, float surface) {
    const bool orthographic = view.eye.w == 0.0F;
    float nearest = std::numeric_limits<float>::max();
    float farthest = 0.0F;
    for (unsigned i = 0; i < 8; ++i) {
        const vec3 corner = scene.corner(i);
        const float distance =
            orthographic ? glm::dot(view.viewPlane, vec4(corner, 1.0F)) : glm::length(corner - vec3(view.eye));
        nearest = std::min(nearest, distance);
        farthest = std::max(farthest, distance);
    }
    if (!orthographic) {
        const vec3 eye(view.eye);
        nearest = glm::length(glm::max(glm::max(scene.min - eye, eye - scene.max), vec3(0.0F)));
    }
    DepthRange range;
    range.far = steppedUp(farthest);
    const float begin = nearest > 0.0F ? 1.0F / steppedUp(1.0F / nearest) : 0.0F;
    // Toward the corners, a point at distance `begin` is less far in front of the camera.
    const float corner = cornerSlope(view);
    range.first = orthographic ? begin : begin / std::sqrt(1.0F + corner * corner);
    range.near = std::max(begin, range.far * nearestSplit);
    if (surface > 0.0F) {
        range.near = std::min(surface, range.far);
        range.first = range.near;
    }
    return range;
}

struct Sphere {
    vec3 center;  // world space
    float radius;
};

// The smallest bounding sphere of the view frustum between two distances.
Sphere boundingSphere(const ViewParams& view, float begin, float end) {
    const float slope = cornerSlope(view);
    const bool orthographic = view.eye.w == 0.0F;
    const float beginRadius = orthographic ? slope : slope * begin;
    const float endRadius = orthographic ? slope : slope * end;
    // Equidistant from near and far corners, but not beyond the far plane.
    const float middle = 0.5F * (begin + end + (endRadius * endRadius - beginRadius * beginRadius) / (end - begin));
    const float along = std::min(middle, end);
    const vec3 onAxis = orthographic ? middleOfView(view) : vec3(view.eye);
    const float ahead = glm::dot(view.viewPlane, vec4(onAxis, 1.0F));
    return {onAxis + vec3(view.viewPlane) * (along - ahead), std::hypot(end - along, endRadius)};
}

float splitAt(const DepthRange& range, float part, float logarithmic) {
    const float uniform = range.near + (range.far - range.near) * part;
    return glm::mix(uniform, range.near * std::pow(range.far / range.near, part), logarithmic);
}

SunShadowParams oneMap(const ShadowMapParams& map) {
    SunShadowParams sun{};
    sun.maps[0] = map;
    sun.count = 1;
    return sun;
}

}  // namespace

SunShadowParams fitCascades(const ViewParams& view, const Aabb& sceneBounds, const vec3& direction,
                            const ShadowSettings& settings, float reach, float nearest) {
    if (sceneBounds.empty()) {
        return oneMap(emptyMap(direction));
    }
    const LightSpace light = lightSpaceOf(sceneBounds, direction);
    const DepthRange range = depthRangeOf(view, sceneBounds, nearest);
    SunShadowParams sun{};
    sun.count = settings.cascades;
    float begin = range.first;  // start of the blend into this cascade
    float lastEnd = begin;
    for (uint i = 0; i < sun.count; ++i) {
        const float part = static_cast<float>(i + 1) / static_cast<float>(sun.count);
        sun.ends[i] = splitAt(range, part, settings.cascadeSplit);
        sun.blends[i] = lighting::cascadeBlend(settings, lastEnd, sun.ends[i]);
        const Sphere sphere = boundingSphere(view, begin, sun.ends[i]);
        const vec2 center(light.worldToLight * sphere.center);
        const float half = sphere.radius + reach;
        sun.maps[i] = snappedMap(light, center - half, vec2(2.0F * half), settings.resolution);
        begin = sun.blends[i];
        lastEnd = sun.ends[i];
    }
    return sun;
}

float filterReach(const Aabb& sceneBounds, const ShadowSettings& settings, float sunSlope) {
    if (sceneBounds.empty()) {
        return 0.0F;
    }
    const float longest = glm::length(sceneBounds.size());
    switch (settings.filter) {
        case ShadowFilter::pcss:
            return longest * sunSlope;
        case ShadowFilter::pcf:
            return settings.radius * (settings.radiusUnit == ShadowUnit::metres
                                          ? 1.0F
                                          : longest / static_cast<float>(settings.resolution));
        default:
            return 0.0F;
    }
}

namespace {

// Share of the scene's diagonal that the longest way of light through its bounding box has.
float longestWay(const Aabb& scene, const vec3& direction) {
    const vec3 ways = scene.size() / glm::max(glm::abs(direction), vec3(1e-6F));
    return std::min({ways.x, ways.y, ways.z, glm::length(scene.size())}) / glm::length(scene.size());
}

// As few cascades as make the texels fine enough where each begins. finest: size of shadows, per metre from the camera.
SunShadowParams enoughCascades(const ViewParams& view, const Aabb& sceneBounds, const vec3& direction,
                               ShadowSettings settings, float reach, float nearest, float finest) {
    SunShadowParams sun{};
    for (settings.cascades = 2; settings.cascades <= maxCascades; ++settings.cascades) {
        sun = fitCascades(view, sceneBounds, direction, settings, reach, nearest);
        float begin = nearest;
        bool fine = true;
        for (uint i = 0; i < sun.count; ++i) {
            fine = fine && sun.maps[i].texelSize <= coarsestInCascades * finest * begin;
            begin = sun.ends[i];
        }
        if (fine) {
            break;
        }
    }
    return sun;
}

}  // namespace

SunShadowParams fitSunShadows(const ViewParams& view, const Aabb& sceneBounds, const vec3& direction,
                              const ShadowSettings& settings, float reach, float nearest) {
    if (settings.extent > 0.0F) {
        return oneMap(centredSunShadow(sceneBounds, direction, settings.extent, settings.resolution));
    }
    if (settings.cascades > 1) {
        return fitCascades(view, sceneBounds, direction, settings, reach);
    }
    const ShadowMapParams one =
        fitSunShadow(view.paddedClipToWorld, sceneBounds, direction, settings.resolution, reach);
    const bool known = nearest > 0.0F && nearest < std::numeric_limits<float>::max() && view.eye.w > 0.0F;
    // Per metre from the camera: a pixel, or the penumbra of what is as far from the surface as the camera.
    const float slope = settings.filter == ShadowFilter::pcss ? reach / glm::length(sceneBounds.size()) : 0.0F;
    const float finest = std::max(view.pixelAngle, 2.0F * slope);
    if (settings.cascades == 1 || !known || one.texelSize <= coarsestInOneMap * finest * nearest) {
        return oneMap(one);
    }
    const float needed = slope > 0.0F ? longestWay(sceneBounds, direction) : 1.0F;
    const float surface = std::exp2(std::floor(std::log2(nearest)));  // changes seldom when the camera moves
    return enoughCascades(view, sceneBounds, direction, settings, needed * reach, surface, finest);
}

}  // namespace reflet
