// Sun shadow maps as boxes in light space.
#include "renderer/draw_shadows/light_space.h"

#include <algorithm>
#include <cmath>

namespace reflet {

LightSpace lightSpaceOf(const Aabb& sceneBounds, const vec3& direction) {
    const vec3 toSun = -direction;
    const vec3 side = glm::normalize(glm::cross(std::abs(toSun.y) < 0.99F ? vec3(0, 1, 0) : vec3(1, 0, 0), toSun));
    const mat3 worldToLight = glm::transpose(mat3(side, glm::cross(toSun, side), toSun));
    return {worldToLight, toSun, transformed(sceneBounds, mat4(worldToLight))};
}

float steppedUp(float metres) {
    return std::exp2(std::ceil(8.0F * std::log2(std::max(metres, 1e-3F))) / 8.0F);
}

ShadowMapParams mapOf(const LightSpace& light, const glm::dvec2& low, const glm::dvec2& high, uint resolution) {
    const float spare = std::max(1e-3F, 1e-4F * glm::length(light.scene.size()));
    const glm::dvec2 size = high - low;
    const double bottom = light.scene.min.z - spare;
    const double depth = light.scene.max.z + spare - bottom;
    // In double: far from the world's origin, float precision would shift the grid.
    glm::dmat4 lightToShadow(0.0);
    lightToShadow[0][0] = 2.0 / size.x;
    lightToShadow[1][1] = 2.0 / size.y;
    lightToShadow[2][2] = 1.0 / depth;
    lightToShadow[3] = glm::dvec4(-(high + low) / size, -bottom / depth, 1.0);
    ShadowMapParams map{};
    map.worldToShadow = mat4(lightToShadow * glm::dmat4(glm::dmat3(light.worldToLight)));
    map.toSun = light.toSun;
    map.texelSize = static_cast<float>(std::max(size.x, size.y) / resolution);
    map.depthRange = static_cast<float>(depth);
    return map;
}

ShadowMapParams snappedMap(const LightSpace& light, const vec2& low, const vec2& extent, uint resolution) {
    constexpr double margin = 2.0;  // texels
    const vec2 all = glm::max(vec2(light.scene.size()), 1e-3F);
    // At most the scene's size, and then at the scene's position.
    const vec2 held = glm::min(extent, all);
    const vec2 from = glm::mix(low, vec2(light.scene.min), glm::greaterThanEqual(extent, all));
    const glm::dvec2 texel = glm::dvec2(held) / (resolution - 2.0 * margin - 1.0);  // one more for the snapping
    const glm::dvec2 origin = (glm::floor(glm::dvec2(from) / texel) - margin) * texel;
    return mapOf(light, origin, origin + texel * static_cast<double>(resolution), resolution);
}

ShadowMapParams emptyMap(const vec3& direction) {
    return {mat4(1.0F), -direction, 1.0F, 1.0F};
}

}  // namespace reflet
