// Path traces small scenes with known results.
#include "reference/harness.h"

#include <cmath>

namespace reflet::test {

View darkView(const vec3& position, const vec3& target, float fovYDegrees) {
    View view;
    view.camera.position = position;
    view.camera.target = target;
    view.camera.fovY = glm::radians(fovYDegrees);
    const vec3 forward = glm::normalize(target - position);
    view.camera.up = std::abs(forward.y) > 0.9F ? vec3(0, 0, -1) : vec3(0, 1, 0);
    view.camera.near = 0.001F;
    return view;
}

Material lambertMaterial(const vec3& albedo, const vec3& emissive) {
    Material material;
    material.baseColor = vec4(albedo, 1.0F);
    material.metallic = 0.0F;
    material.roughness = 1.0F;
    material.emissive = emissive;
    return material;
}

void add(Scene& scene, const Material& material, Mesh mesh, const mat4& objectToWorld) {
    builtin::place(scene, "thing", builtin::addMaterial(scene, material), std::move(mesh), objectToWorld);
}

Mesh square(const vec3& center, const vec3& normal, float halfSize, const glm::uvec2& cells) {
    const vec3 right = std::abs(normal.x) > 0.5F ? vec3(0, 0, 1) : vec3(1, 0, 0);
    const vec3 up = glm::cross(normal, right);  // cross(right, up) is the normal
    return builtin::patch({center, right * halfSize, up * halfSize, cells, {1, 1}});
}

ReferenceOptions lambert(uint32_t bounces, uint32_t samples) {
    ReferenceOptions options;
    options.bounces = bounces;
    options.samples = samples;
    options.lambertOnly = true;
    return options;
}

vec3 mean(const FloatImage& image) {
    glm::dvec3 sum(0.0);
    const size_t channels = image.channels.size();
    for (size_t i = 0; i < image.data.size(); ++i) {
        sum[static_cast<int>(i % channels)] += image.data[i];
    }
    const size_t pixels = image.data.size() / channels;
    return sum / static_cast<double>(pixels);
}

float pixel(const FloatImage& image, uint32_t x, uint32_t y, uint32_t channel) {
    return image.data.at((size_t(y) * image.width + x) * image.channels.size() + channel);
}

vec3 color(const FloatImage& image, uint32_t x, uint32_t y) {
    return {pixel(image, x, y, 0), pixel(image, x, y, 1), pixel(image, x, y, 2)};
}

}  // namespace reflet::test
