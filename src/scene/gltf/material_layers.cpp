// Converts the material extensions for glass and clear coats: KHR_materials_transmission, KHR_materials_volume and
// KHR_materials_clearcoat.
#include "scene/gltf/material.h"

namespace reflet {

namespace {

float floatOr(const tinygltf::Value& object, const char* name, double otherwise) {
    return static_cast<float>(object.Has(name) ? object.Get(name).GetNumberAsDouble() : otherwise);
}

}  // namespace

Transmission GltfMaterials::transmissionOf(const tinygltf::ExtensionMap& extensions, const std::string& part) {
    Transmission result;
    const auto found = extensions.find("KHR_materials_transmission");
    if (found == extensions.end()) {
        return result;  // a volume beneath a surface that nothing passes is not seen
    }
    const auto& [name, transmission] = *found;
    result.factor = floatOr(transmission, "transmissionFactor", 0.0);
    result.texture = slotOf(transmission, "transmissionTexture", part + name);
    const auto inside = extensions.find("KHR_materials_volume");
    if (inside == extensions.end()) {
        return result;
    }
    const auto& [volumeName, volume] = *inside;
    result.thickness = floatOr(volume, "thicknessFactor", 0.0);
    result.thicknessTexture = slotOf(volume, "thicknessTexture", part + volumeName);
    const float distance = floatOr(volume, "attenuationDistance", 0.0);
    if (distance > 0.0F) {
        result.attenuationDistance = distance;
    } else if (volume.Has("attenuationDistance")) {
        report_.warn("attenuation", part + volumeName + ".attenuationDistance",
                     "the glass will be clear: 0 is not greater than 0");
    }
    for (int c = 0; volume.Has("attenuationColor") && c < 3; ++c) {
        result.attenuationColor[c] = static_cast<float>(volume.Get("attenuationColor").Get(c).GetNumberAsDouble());
    }
    return result;
}

Clearcoat GltfMaterials::clearcoatOf(const tinygltf::ExtensionMap& extensions, const std::string& part) {
    Clearcoat result;
    const auto found = extensions.find("KHR_materials_clearcoat");
    if (found == extensions.end()) {
        return result;
    }
    const auto& [name, coat] = *found;
    result.factor = floatOr(coat, "clearcoatFactor", 0.0);
    result.roughness = floatOr(coat, "clearcoatRoughnessFactor", 0.0);
    result.texture = slotOf(coat, "clearcoatTexture", part + name);
    result.roughnessTexture = slotOf(coat, "clearcoatRoughnessTexture", part + name);
    result.normalTexture = slotOf(coat, "clearcoatNormalTexture", part + name);
    if (coat.Has("clearcoatNormalTexture")) {
        result.normalScale = floatOr(coat.Get("clearcoatNormalTexture"), "scale", 1.0);
    }
    return result;
}

}  // namespace reflet
