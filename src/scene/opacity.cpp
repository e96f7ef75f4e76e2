// Finds materials that are blended by name only.
#include "scene/opacity.h"

#include "scene/property.h"

#include <algorithm>
#include <map>
#include <vector>

namespace reflet {

namespace {

bool alphaIsOne(const TextureImage& image) {
    for (size_t i = 3; i < image.rgba.size(); i += 4) {
        if (image.rgba[i] != 255) {
            return false;
        }
    }
    return true;
}

bool alphaIsOne(const Mesh& mesh) {
    return std::ranges::all_of(mesh.attributes, [](const VertexAttributes& v) { return v.color.a == 65535; });
}

}  // namespace

void makeOpaqueWhereAlphaIsOne(Scene& scene) {
    std::map<int32_t, bool> images;  // each is looked through once
    std::vector<bool> opaque(scene.materials.size());
    const std::vector<bool> fades = materialsWithAnimated(scene, Property::baseColor);
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        if (!material.blended || material.baseColor.a < 1.0F || fades[i]) {
            continue;
        }
        const int32_t image = material.baseColorTexture.image;
        if (image >= 0 && !images.contains(image)) {
            images[image] = alphaIsOne(scene.images.at(static_cast<size_t>(image)));
        }
        opaque[i] = image < 0 || images[image];
    }
    for (const Mesh& mesh : scene.meshes) {
        if (opaque.at(mesh.material) && !alphaIsOne(mesh)) {
            opaque[mesh.material] = false;
        }
    }
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        if (opaque[i]) {
            scene.materials[i].blended = false;
            scene.materials[i].alphaCutoff = 0.0F;
        }
    }
}

}  // namespace reflet
