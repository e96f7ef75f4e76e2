// Converts the material extensions for glass and layers: KHR_materials_transmission, KHR_materials_volume,
// KHR_materials_dispersion, KHR_materials_clearcoat, KHR_materials_sheen, KHR_materials_anisotropy,
// KHR_materials_iridescence and KHR_materials_diffuse_transmission.
#include "scene/gltf/material.h"

namespace reflet {

namespace {

float floatOr(const tinygltf::Value& object, const char* name, double otherwise) {
    return static_cast<float>(object.Has(name) ? object.Get(name).GetNumberAsDouble() : otherwise);
}

vec3 colorOr(const tinygltf::Value& object, const char* name, vec3 color) {
    for (int c = 0; object.Has(name) && c < 3; ++c) {
        color[c] = static_cast<float>(object.Get(name).Get(c).GetNumberAsDouble());
    }
    return color;
}

}  // namespace

Transmission GltfMaterials::transmissionOf(const tinygltf::ExtensionMap& extensions, const std::string& part) {
    Transmission result;
    const auto found = extensions.find("KHR_materials_transmission");
    if (found == extensions.end()) {
        return result;  // a volume beneath a surface that nothing passes is not seen
    }
    const tinygltf::Value& transmission = found->second;
    result.factor = floatOr(transmission, "transmissionFactor", 0.0);
    result.texture = slotOf(transmission, "transmissionTexture");
    const auto inside = extensions.find("KHR_materials_volume");
    if (inside == extensions.end()) {
        return result;
    }
    const auto& [volumeName, volume] = *inside;
    result.thickness = floatOr(volume, "thicknessFactor", 0.0);
    if (const auto spread = extensions.find("KHR_materials_dispersion"); spread != extensions.end()) {
        result.dispersion = floatOr(spread->second, "dispersion", 0.0);
    }
    result.thicknessTexture = slotOf(volume, "thicknessTexture");
    const float distance = floatOr(volume, "attenuationDistance", 0.0);
    if (distance > 0.0F) {
        result.attenuationDistance = distance;
    } else if (volume.Has("attenuationDistance")) {
        report_.warn("attenuation", part + volumeName + ".attenuationDistance",
                     "the glass will be clear: 0 is not greater than 0");
    }
    result.attenuationColor = colorOr(volume, "attenuationColor", result.attenuationColor);
    return result;
}

Sheen GltfMaterials::sheenOf(const tinygltf::ExtensionMap& extensions) {
    Sheen result;
    const auto found = extensions.find("KHR_materials_sheen");
    if (found == extensions.end()) {
        return result;
    }
    const tinygltf::Value& sheen = found->second;
    result.color = colorOr(sheen, "sheenColorFactor", vec3(0.0F));
    result.roughness = floatOr(sheen, "sheenRoughnessFactor", 0.0);
    result.colorTexture = slotOf(sheen, "sheenColorTexture");
    result.roughnessTexture = slotOf(sheen, "sheenRoughnessTexture");
    return result;
}

Anisotropy GltfMaterials::anisotropyOf(const tinygltf::ExtensionMap& extensions) {
    Anisotropy result;
    const auto found = extensions.find("KHR_materials_anisotropy");
    if (found == extensions.end()) {
        return result;
    }
    const tinygltf::Value& anisotropy = found->second;
    result.strength = floatOr(anisotropy, "anisotropyStrength", 0.0);
    result.rotation = floatOr(anisotropy, "anisotropyRotation", 0.0);
    result.texture = slotOf(anisotropy, "anisotropyTexture");
    return result;
}

Iridescence GltfMaterials::iridescenceOf(const tinygltf::ExtensionMap& extensions) {
    Iridescence result;
    const auto found = extensions.find("KHR_materials_iridescence");
    if (found == extensions.end()) {
        return result;
    }
    const tinygltf::Value& film = found->second;
    result.factor = floatOr(film, "iridescenceFactor", 0.0);
    result.ior = floatOr(film, "iridescenceIor", result.ior);
    result.thinnest = floatOr(film, "iridescenceThicknessMinimum", result.thinnest);
    result.thickest = floatOr(film, "iridescenceThicknessMaximum", result.thickest);
    result.texture = slotOf(film, "iridescenceTexture");
    result.thicknessTexture = slotOf(film, "iridescenceThicknessTexture");
    return result;
}

DiffuseTransmission GltfMaterials::diffuseTransmissionOf(const tinygltf::ExtensionMap& extensions) {
    DiffuseTransmission result;
    const auto found = extensions.find("KHR_materials_diffuse_transmission");
    if (found == extensions.end()) {
        return result;
    }
    const tinygltf::Value& transmission = found->second;
    result.factor = floatOr(transmission, "diffuseTransmissionFactor", 0.0);
    result.color = colorOr(transmission, "diffuseTransmissionColorFactor", result.color);
    result.texture = slotOf(transmission, "diffuseTransmissionTexture");
    result.colorTexture = slotOf(transmission, "diffuseTransmissionColorTexture");
    return result;
}

Clearcoat GltfMaterials::clearcoatOf(const tinygltf::ExtensionMap& extensions) {
    Clearcoat result;
    const auto found = extensions.find("KHR_materials_clearcoat");
    if (found == extensions.end()) {
        return result;
    }
    const tinygltf::Value& coat = found->second;
    result.factor = floatOr(coat, "clearcoatFactor", 0.0);
    result.roughness = floatOr(coat, "clearcoatRoughnessFactor", 0.0);
    result.texture = slotOf(coat, "clearcoatTexture");
    result.roughnessTexture = slotOf(coat, "clearcoatRoughnessTexture");
    result.normalTexture = slotOf(coat, "clearcoatNormalTexture");
    if (coat.Has("clearcoatNormalTexture")) {
        result.normalScale = floatOr(coat.Get("clearcoatNormalTexture"), "scale", 1.0);
    }
    return result;
}

}  // namespace reflet
