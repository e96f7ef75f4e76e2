// Fits a single shadow map of the sun to the visible part of the scene's bounding box, a convex polyhedron clipped by
// the frustum planes; or places it at a fixed extent.
#include "renderer/draw_shadows/light_space.h"
#include "renderer/draw_shadows/shadow_maps.h"

#include <array>
#include <cmath>

namespace reflet {

namespace {

// On the stack: this runs in every frame. Four corners, and one more for each of at most ten planes that clip it; the
// rest is room for rounding errors.
struct Polygon {
    std::array<vec3, 32> points{};
    size_t count = 0;

    void add(const vec3& point) {
        if (count < points.size()) {
            points[count++] = point;
        }
    }
};

// The part of a convex polygon on the side where dot(plane, (p, 1)) >= 0 (Sutherland and Hodgman 1974).
Polygon clip(const Polygon& polygon, const vec4& plane) {
    Polygon kept;
    for (size_t i = 0; i < polygon.count; ++i) {
        const vec3& a = polygon.points[i];
        const vec3& b = polygon.points[(i + 1) % polygon.count];
        const float da = glm::dot(plane, vec4(a, 1.0F));
        const float db = glm::dot(plane, vec4(b, 1.0F));
        if (da >= 0.0F) {
            kept.add(a);
        }
        if ((da >= 0.0F) != (db >= 0.0F)) {
            kept.add(glm::mix(a, b, da / (da - db)));
        }
    }
    return kept;
}

std::array<Polygon, 6> boxFaces(const Aabb& box) {
    constexpr unsigned faces[6][4] = {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1},
                                      {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}};
    std::array<Polygon, 6> polygons;
    for (size_t i = 0; i < 6; ++i) {
        for (const unsigned corner : faces[i]) {
            polygons[i].add(box.corner(corner));
        }
    }
    return polygons;
}

// Left, right, top, bottom, near. There is no far plane: the box limits the depth.
std::array<vec4, 5> frustumPlanes(const mat4& worldToClip) {
    const mat4 rows = glm::transpose(worldToClip);
    return {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1], rows[3] - rows[2]};
}

}  // namespace

// The intersection of box and frustum: the box's faces clipped by the frustum, and
// (where frustum edges pass through the box) the frustum's faces, as large polygons, clipped by the box.
Aabb visibleBounds(const Aabb& box, const mat4& clipToWorld, const mat3& axes) {
    const auto planes = frustumPlanes(glm::inverse(clipToWorld));
    Aabb seen;
    const auto addClipped = [&](Polygon polygon, size_t skip) {
        for (size_t i = 0; i < planes.size(); ++i) {
            polygon = i == skip ? polygon : clip(polygon, planes[i]);
        }
        for (size_t i = 0; i < polygon.count; ++i) {
            seen.add(axes * polygon.points[i]);
        }
    };
    for (const Polygon& face : boxFaces(box)) {
        addClipped(face, planes.size());
    }
    const float reach = glm::length(box.size()) * 4.0F;
    for (size_t i = 0; i < planes.size(); ++i) {
        const float length = glm::length(vec3(planes[i]));
        const vec3 n = vec3(planes[i]) / length;
        const vec3 onPlane = box.center() - n * (glm::dot(n, box.center()) + planes[i].w / length);
        const vec3 t = glm::normalize(glm::cross(n, std::abs(n.x) < 0.5F ? vec3(1, 0, 0) : vec3(0, 1, 0))) * reach;
        const vec3 b = glm::normalize(glm::cross(n, t)) * reach;
        Polygon large;
        for (const vec3& corner : {onPlane - t - b, onPlane + t - b, onPlane + t + b, onPlane - t + b}) {
            large.add(corner);
        }
        for (int axis = 0; axis < 3; ++axis) {
            vec4 lower(0.0F, 0.0F, 0.0F, -box.min[axis]);
            vec4 upper(0.0F, 0.0F, 0.0F, box.max[axis]);
            lower[axis] = 1.0F;
            upper[axis] = -1.0F;
            large = clip(clip(large, lower), upper);
        }
        addClipped(large, i);
    }
    return seen;
}

ShadowMapParams fitSunShadow(const mat4& clipToWorld, const Aabb& sceneBounds, const vec3& direction, uint resolution,
                             float reach) {
    if (sceneBounds.empty()) {
        return emptyMap(direction);
    }
    const LightSpace light = lightSpaceOf(sceneBounds, direction);
    Aabb seen = visibleBounds(sceneBounds, clipToWorld, light.worldToLight);
    if (seen.empty()) {  // the scene is out of view
        seen = light.scene;
    }
    // Rounded up to steps, so that texels do not change their size with every camera move.
    const vec2 low = glm::max(vec2(seen.min) - reach, vec2(light.scene.min));
    const vec2 high = glm::min(vec2(seen.max) + reach, vec2(light.scene.max));
    const vec2 extent(steppedUp(high.x - low.x), steppedUp(high.y - low.y));
    return snappedMap(light, low, extent, resolution);
}

ShadowMapParams wholeSunShadow(const Aabb& sceneBounds, const vec3& direction, uint resolution) {
    if (sceneBounds.empty()) {
        return emptyMap(direction);
    }
    const LightSpace light = lightSpaceOf(sceneBounds, direction);
    return snappedMap(light, vec2(light.scene.min), vec2(light.scene.size()), resolution);
}

ShadowMapParams centredSunShadow(const Aabb& sceneBounds, const vec3& direction, float extent, uint resolution) {
    if (sceneBounds.empty()) {
        return emptyMap(direction);
    }
    return mapOf(lightSpaceOf(sceneBounds, direction), glm::dvec2(-extent), glm::dvec2(extent), resolution);
}

}  // namespace reflet
