// A mirror on a wall, and objects around it.
#include "pass/mirror_room.h"

#include <cmath>

namespace reflet::test {

namespace {

void addBox(Scene& scene, const std::string& name, const vec3& color, const vec3& center, const vec3& half) {
    builtin::place(scene, name, builtin::addMaterial(scene, lambertMaterial(color)), builtin::box(half),
                   builtin::at(center));
}

TextureSlot waves(Scene& scene) {
    TextureImage image{"waves", 128, 128, {}};
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const float slope = 0.06F * std::sin(6.2831853F * static_cast<float>(x) / 128.0F * 2.0F);
            const vec3 n = 0.5F + 0.5F * glm::normalize(vec3(slope, 0.0F, 1.0F));
            for (const float c : {n.x, n.y, n.z, 1.0F}) {
                image.rgba.push_back(static_cast<uint8_t>(std::lround(255.0F * c)));
            }
        }
    }
    return builtin::addTexture(scene, std::move(image));
}

}  // namespace

Scene makeMirrorRoom(const MirrorRoom& room) {
    Scene scene = sceneOf(lambertMaterial(vec3(0.6F)), builtin::ground({6, 8}, {1, 1}, {1, 1}));
    Material metal = lambertMaterial(vec3(0.95F));
    metal.metallic = 1.0F;
    metal.roughness = room.roughness;
    if (room.waves) {
        metal.normalTexture = waves(scene);
    }
    builtin::place(scene, "mirror", builtin::addMaterial(scene, metal),
                   builtin::patch({{0, 0, 0}, {2.5F, 0, 0}, {0, 1.4F, 0}, {1, 1}, {1, 1}}),
                   builtin::at({0, 1.5F, -2}) * room.turn);
    addBox(scene, "left", {0.8F, 0.15F, 0.1F}, {-1.2F, 0.6F, 0.3F}, {0.4F, 0.6F, 0.3F});
    addBox(scene, "right", {0.1F, 0.2F, 0.8F}, {1.3F, 0.4F, -0.6F}, {0.3F, 0.4F, 0.4F});
    addBox(scene, "behind the camera", {0.8F, 0.7F, 0.1F}, {0.3F, 1.0F, 6.0F}, {0.8F, 1.0F, 0.3F});
    addBox(scene, "behind the mirror", {0.1F, 0.8F, 0.1F}, {0.3F, 1.5F, -4.5F}, {1.5F, 1.4F, 0.3F});
    addBox(scene, "through the mirror", {0.5F, 0.1F, 0.6F}, {-1.0F, 2.0F, -4.0F}, {0.25F, 0.25F, 2.1F});
    return scene;
}

View viewOfMirrorRoom() {
    View view;
    view.camera.position = {0.9F, 1.7F, 3.5F};
    view.camera.target = {-0.1F, 1.3F, -2.0F};
    view.sun.direction = glm::normalize(vec3(-0.4F, -0.8F, -0.45F));
    view.sun.irradiance = vec3(3.0F);
    view.sun.angularDiameter = 0.0F;
    view.environment.radiance = {0.3F, 0.4F, 0.6F};
    return view;
}

std::vector<bool> smoothMirrorPixels(const Pictures& p, const FloatImage& picture, float largestStep) {
    const auto at = [&](unsigned x, unsigned y) {
        const float* v = &picture.data[(size_t(y) * picture.width + x) * 3];
        return vec3(v[0], v[1], v[2]);
    };
    std::vector<bool> mask(size_t(p.size.x) * p.size.y);
    for (unsigned y = 1; y + 1 < p.size.y; ++y) {
        for (unsigned x = 1; x + 1 < p.size.x; ++x) {
            bool smooth = true;
            for (unsigned i = 0; i < 9; ++i) {
                const unsigned u = x + i % 3 - 1;
                const unsigned v = y + i / 3 - 1;
                smooth = smooth && p.value("metallic", u, v) > 0.5F && p.hasSurface(u, v) &&
                         glm::length(at(u, v) - at(x, y)) <= largestStep * glm::length(at(x, y));
            }
            mask[size_t(y) * p.size.x + x] = smooth;
        }
    }
    return mask;
}

}  // namespace reflet::test
