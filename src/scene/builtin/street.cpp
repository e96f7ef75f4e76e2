// A wet street after sunset: puddles by a roughness map on uneven asphalt, neon signs and lit windows, lamps with soft
// shadows, a car of clear-coated paint, a railing and cables, brick and plaster fronts, a sky with some light left.
#include "scene/builtin/street.h"

#include "scene/builtin/assemble.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/scenes.h"

#include <cmath>
#include <memory>

namespace reflet::builtin {
namespace {

// Radiance of the sky after sunset; the glow is ahead (-z), where the street ends.
vec3 duskSky(const vec3& direction) {
    const float up = std::max(direction.y, 0.0F);
    const float ahead = 0.5F - 0.5F * direction.z;
    const vec3 zenith(0.035F, 0.075F, 0.2F);
    const vec3 blue = vec3(0.07F, 0.15F, 0.33F);
    const vec3 rose = glm::mix(vec3(0.05F, 0.06F, 0.13F), vec3(0.5F, 0.2F, 0.27F), ahead * ahead);
    const vec3 orange = glm::mix(vec3(0.07F, 0.08F, 0.15F), vec3(1.25F, 0.48F, 0.15F), ahead * ahead * ahead);
    vec3 color = glm::mix(orange, rose, glm::smoothstep(0.0F, 0.16F, up));
    color = glm::mix(color, blue, glm::smoothstep(0.08F, 0.4F, up));
    color = glm::mix(color, zenith, glm::smoothstep(0.3F, 0.95F, up));
    const vec3 place(5.0F * direction.x, 16.0F * direction.y, 5.0F * direction.z);
    const float cloud = glm::smoothstep(-0.05F, 0.45F, fractalNoise(place, 3, 91U));
    const vec3 lit = glm::mix(vec3(0.05F, 0.05F, 0.09F), vec3(0.75F, 0.3F, 0.27F), ahead * ahead);
    color = glm::mix(color, lit, 0.6F * cloud * glm::smoothstep(0.03F, 0.12F, up) * (1.0F - up));
    return direction.y < 0.0F ? vec3(0.02F) : 1.7F * color;
}

std::shared_ptr<const FloatImage> skyImage() {
    auto image = std::make_shared<FloatImage>(FloatImage{640, 320, {"R", "G", "B"}, {}});
    image->data.reserve(size_t{3} * image->width * image->height);
    for (uint32_t y = 0; y < image->height; ++y) {
        const float theta = pi * (static_cast<float>(y) + 0.5F) / static_cast<float>(image->height);
        for (uint32_t x = 0; x < image->width; ++x) {
            const float phi = 2.0F * pi * ((static_cast<float>(x) + 0.5F) / static_cast<float>(image->width) - 0.5F);
            const vec3 d(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
            const vec3 color = duskSky(d);
            image->data.insert(image->data.end(), {color.x, color.y, color.z});
        }
    }
    return image;
}

}  // namespace

Scene makeStreet() {
    Scene scene;
    scene.name = "street";
    street::addGround(scene);
    street::addHouses(scene);
    street::addSigns(scene);
    street::addLights(scene);
    street::addThings(scene);
    street::addCar(scene, at({2.15F, 0.0F, -0.6F}) * turned(166.0F));
    scene.cameras.push_back(camera("main", {-0.6F, 0.55F, 6.6F}, {0.1F, 1.55F, -10.0F}, 55));
    scene.sun = sun({0.35F, -0.85F, 0.25F}, {0.16F, 0.24F, 0.42F});  // the moon
    scene.environment.image = skyImage();
    return scene;
}

}  // namespace reflet::builtin
