// Fits the nested shadow tiles of directional lamps to the scene and to the view.
#include "renderer/draw_shadows/distant_lamp.h"

#include "renderer/draw_shadows/light_space.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

using glm::dvec2;

// Distances of the entry into a box and of the exit from it along a ray, not before its origin. Both are the same if
// the ray misses the box.
vec2 crossing(const Aabb& box, const vec3& origin, const vec3& direction) {
    float enter = 0.0F;
    float leave = glm::length(box.size()) + glm::distance(origin, box.center());
    for (int axis = 0; axis < 3; ++axis) {
        const float d = std::abs(direction[axis]) > 1e-6F ? direction[axis] : std::copysign(1e-6F, direction[axis]);
        const float a = (box.min[axis] - origin[axis]) / d;
        const float b = (box.max[axis] - origin[axis]) / d;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    const float beside = std::max(glm::dot(box.center() - origin, direction), 0.0F);
    return enter <= leave ? vec2(enter, leave) : vec2(beside);
}

// On the view axis, as far in front of the camera as leaves it at the edge of a tile; at most where the axis leaves the
// scene, which is often the ground.
vec3 inView(const LampShadowScene& scene, float half) {
    constexpr float ahead = 0.7F;
    const vec2 inside = crossing(scene.bounds, scene.eye, scene.ahead);
    const vec3 at = scene.eye + std::min(inside.x + ahead * half, inside.y) * scene.ahead;
    return glm::clamp(at, scene.bounds.min, scene.bounds.max);
}

dvec2 snapped(const dvec2& at, double step) {
    return glm::round(at / step) * step;
}

}  // namespace

LampShadow nestedShadow(const LampParams& lamp, uint32_t index, uint32_t firstTile, uint32_t tileSize,
                        const LampShadowScene& scene) {
    constexpr float margin = 3.0F;  // texels: two for filters, one for snapping
    constexpr uint32_t stepsPerTile = 16;
    const LightSpace light = lightSpaceOf(scene.bounds, -lamp.toLamp);
    const float spare = std::max(1e-3F, 1e-4F * glm::length(light.scene.size()));
    const auto side = static_cast<float>(tileSize);
    const float half =
        steppedUp(0.5F * std::max(light.scene.size().x, light.scene.size().y)) * side / (side - 2.0F * margin);
    const double texel = 2.0 * double(half) / tileSize;
    std::array<dvec2, nestedTiles> middles;
    middles[0] = snapped(dvec2(light.scene.center()), texel);
    for (uint32_t i = 1; i < nestedTiles; ++i) {
        const double step = std::ldexp(texel, -static_cast<int>(i)) * std::max(tileSize / stepsPerTile, 1U);
        const double mine = std::ldexp(double(half), -static_cast<int>(i));
        const dvec2 wanted(light.worldToLight * inView(scene, static_cast<float>(mine)));
        // Half the width of the tile before is twice this one's; the rest is for snapping.
        const double room = mine - step;
        middles.at(i) = snapped(glm::clamp(wanted, middles.at(i - 1) - room, middles.at(i - 1) + room), step);
    }
    LampShadow shadow{};
    shadow.lamp = lamp;
    shadow.index = index;
    shadow.firstTile = firstTile;
    shadow.tiles = nestedTiles;
    shadow.halfTangent = half;
    shadow.near = light.scene.size().z + 2.0F * spare;
    shadow.middle1 = vec2(middles[1] - middles[0]);
    shadow.middle2 = vec2(middles[2] - middles[0]);
    shadow.middle3 = vec2(middles[3] - middles[0]);
    // Light space has z toward the light, tiles away from it.
    const mat3 axes = glm::transpose(light.worldToLight);
    shadow.worldToTile = glm::transpose(mat3(axes[0], axes[1], -axes[2]));
    shadow.lamp.position = axes * vec3(vec2(middles[0]), light.scene.max.z + spare);
    return shadow;
}

mat4 worldToNestedTile(const LampShadow& shadow, uint32_t tile) {
    const std::array<vec2, nestedTiles> middles{vec2(0.0F), shadow.middle1, shadow.middle2, shadow.middle3};
    const float half = std::ldexp(shadow.halfTangent, -static_cast<int>(tile));
    mat4 tileToClip(1.0F);
    tileToClip[0][0] = 1.0F / half;
    tileToClip[1][1] = 1.0F / half;
    tileToClip[2][2] = -1.0F / shadow.near;
    tileToClip[3] = vec4(-middles.at(tile) / half, 1.0F, 1.0F);
    return tileToClip * mat4(shadow.worldToTile) * glm::translate(mat4(1.0F), -shadow.lamp.position);
}

}  // namespace reflet
