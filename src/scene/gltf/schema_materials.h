// The properties of materials in a glTF document, as tables: a part of schema_tables.cpp.
#pragma once

#include "scene/environment.h"
#include "scene/gltf/schema_tables.h"
#include "scene/gltf/schema_values.h"

namespace reflet::gltf_schema {

constexpr std::array textureTransform{
    Field{.name = "offset", .array = true, .items = 2},
    Field{.name = "rotation"},
    Field{.name = "scale", .array = true, .items = 2},
    Field{.name = "texCoord", .type = Type::integer, .max = maxInt},
};
constexpr std::array textureExtensions{
    Field{.name = "KHR_texture_transform", .type = Type::object, .fields = textureTransform},
};
constexpr std::array textureInfo{
    Field{.name = "index", .type = Type::index, .required = true, .refersTo = "textures"},
    Field{.name = "texCoord", .type = Type::integer, .max = maxInt},
    Field{.name = "scale"},
    Field{.name = "strength", .min = 0, .max = 1},
    Field{.name = "extensions", .type = Type::object, .fields = textureExtensions},
};
constexpr std::array metallicRoughness{
    Field{.name = "baseColorFactor", .array = true, .items = 4, .min = 0, .max = 1},
    Field{.name = "baseColorTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
    Field{.name = "metallicFactor", .min = 0, .max = 1},
    Field{.name = "roughnessFactor", .min = 0, .max = 1},
    Field{.name = "metallicRoughnessTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
};
constexpr std::array emissiveStrength{Field{.name = "emissiveStrength", .min = 0, .max = largestRadiance}};
constexpr std::array ior{Field{.name = "ior", .min = 0}};
constexpr std::array specular{
    Field{.name = "specularFactor", .min = 0, .max = 1},
    Field{.name = "specularTexture", .type = Type::object, .fields = textureInfo},
    Field{.name = "specularColorFactor", .array = true, .items = 3, .min = 0},
    Field{.name = "specularColorTexture", .type = Type::object, .fields = textureInfo},
};
constexpr std::array transmission{
    Field{.name = "transmissionFactor", .min = 0, .max = 1},
    Field{.name = "transmissionTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
};
constexpr std::array volume{
    Field{.name = "thicknessFactor", .min = 0},
    Field{.name = "thicknessTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
    Field{.name = "attenuationDistance", .min = 0},
    Field{.name = "attenuationColor", .array = true, .items = 3, .min = 0, .max = 1},
};
constexpr std::array clearcoat{
    Field{.name = "clearcoatFactor", .min = 0, .max = 1},
    Field{.name = "clearcoatTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
    Field{.name = "clearcoatRoughnessFactor", .min = 0, .max = 1},
    Field{.name = "clearcoatRoughnessTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
    Field{.name = "clearcoatNormalTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
};
constexpr std::array sheen{
    Field{.name = "sheenColorFactor", .array = true, .items = 3, .min = 0, .max = 1},
    Field{.name = "sheenColorTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
    Field{.name = "sheenRoughnessFactor", .min = 0, .max = 1},
    Field{.name = "sheenRoughnessTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
};
constexpr std::array anisotropy{
    Field{.name = "anisotropyStrength", .min = 0, .max = 1},
    Field{.name = "anisotropyRotation"},
    Field{.name = "anisotropyTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
};
constexpr std::array dispersion{Field{.name = "dispersion", .min = 0}};
constexpr std::array<Field, 0> unlit{};
constexpr std::array iridescence{
    Field{.name = "iridescenceFactor", .min = 0, .max = 1},
    Field{.name = "iridescenceTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
    Field{.name = "iridescenceIor", .min = 1},
    Field{.name = "iridescenceThicknessMinimum", .min = 0},
    Field{.name = "iridescenceThicknessMaximum", .min = 0},
    Field{.name = "iridescenceThicknessTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
};
constexpr std::array diffuseTransmission{
    Field{.name = "diffuseTransmissionFactor", .min = 0, .max = 1},
    Field{.name = "diffuseTransmissionTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
    Field{.name = "diffuseTransmissionColorFactor", .array = true, .items = 3, .min = 0, .max = 1},
    Field{.name = "diffuseTransmissionColorTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
};
constexpr std::array specularGlossiness{
    Field{.name = "diffuseFactor", .array = true, .items = 4, .min = 0, .max = 1},
    Field{.name = "diffuseTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
    Field{.name = "specularFactor", .array = true, .items = 3, .min = 0, .max = 1},
    Field{.name = "glossinessFactor", .min = 0, .max = 1},
    Field{.name = "specularGlossinessTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
};
constexpr std::array materialExtensions{
    Field{.name = "KHR_materials_anisotropy", .type = Type::object, .fields = anisotropy},
    Field{.name = "KHR_materials_clearcoat", .type = Type::object, .fields = clearcoat},
    Field{.name = "KHR_materials_diffuse_transmission", .type = Type::object, .fields = diffuseTransmission},
    Field{.name = "KHR_materials_dispersion", .type = Type::object, .fields = dispersion},
    Field{.name = "KHR_materials_emissive_strength", .type = Type::object, .fields = emissiveStrength},
    Field{.name = "KHR_materials_ior", .type = Type::object, .fields = ior},
    Field{.name = "KHR_materials_iridescence", .type = Type::object, .fields = iridescence},
    Field{.name = "KHR_materials_pbrSpecularGlossiness", .type = Type::object, .fields = specularGlossiness},
    Field{.name = "KHR_materials_sheen", .type = Type::object, .fields = sheen},
    Field{.name = "KHR_materials_specular", .type = Type::object, .fields = specular},
    Field{.name = "KHR_materials_transmission", .type = Type::object, .fields = transmission},
    Field{.name = "KHR_materials_unlit", .type = Type::object, .fields = unlit},
    Field{.name = "KHR_materials_volume", .type = Type::object, .fields = volume},
};
constexpr std::array materialExtras{
    Field{.name = "camera", .type = Type::text},  // Reflet's own: Material::camera
};
constexpr std::array material{
    Field{.name = "name", .type = Type::text},
    Field{.name = "pbrMetallicRoughness", .type = Type::object, .fields = metallicRoughness},
    Field{.name = "normalTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
    Field{.name = "occlusionTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
    Field{.name = "emissiveTexture", .type = Type::object, .fields = textureInfo, .without = noTexture},
    Field{.name = "emissiveFactor", .array = true, .items = 3, .min = 0, .max = 1},
    Field{.name = "alphaMode", .type = Type::text, .words = alphaModes},
    Field{.name = "alphaCutoff", .min = 0},
    Field{.name = "doubleSided", .type = Type::boolean},
    Field{.name = "extensions", .type = Type::object, .fields = materialExtensions},
    Field{.name = "extras", .type = Type::object, .fields = materialExtras, .anyType = true},
};

}  // namespace reflet::gltf_schema
