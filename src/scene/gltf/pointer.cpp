// Parses JSON pointers (RFC 6901) of KHR_animation_pointer.
#include "scene/gltf/pointer.h"

#include "scene/gltf/texture_paths.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace reflet {

namespace {

using Of = GltfPointer::Of;

struct Array {
    Of of;
    std::string_view path;  ///< with slashes around it
    std::string_view name;
};
constexpr std::array<Array, 5> arrays{{{Of::node, "/nodes/", "nodes"},
                                       {Of::mesh, "/meshes/", "meshes"},
                                       {Of::material, "/materials/", "materials"},
                                       {Of::camera, "/cameras/", "cameras"},
                                       {Of::light, "/extensions/KHR_lights_punctual/lights/", "lights"}}};

struct Row {
    Of of;
    std::string_view path;  ///< below the object
    Property property;
    int components;
};
constexpr std::array<Row, 40> rows{{
    {Of::node, "extensions/KHR_node_visibility/visible", Property::visible, 1},
    {Of::camera, "perspective/yfov", Property::fovY, 1},
    {Of::camera, "perspective/znear", Property::near, 1},
    {Of::camera, "orthographic/znear", Property::near, 1},
    {Of::camera, "orthographic/zfar", Property::far, 1},
    {Of::camera, "orthographic/ymag", Property::orthographicHeight, 1},
    {Of::light, "color", Property::lightColor, 3},
    {Of::light, "intensity", Property::lightIntensity, 1},
    {Of::light, "range", Property::lightRange, 1},
    {Of::light, "spot/innerConeAngle", Property::innerCone, 1},
    {Of::light, "spot/outerConeAngle", Property::outerCone, 1},
    {Of::material, "alphaCutoff", Property::alphaCutoff, 1},
    {Of::material, "emissiveFactor", Property::emissiveFactor, 3},
    {Of::material, "normalTexture/scale", Property::normalScale, 1},
    {Of::material, "occlusionTexture/strength", Property::occlusionStrength, 1},
    {Of::material, "pbrMetallicRoughness/baseColorFactor", Property::baseColor, 4},
    {Of::material, "pbrMetallicRoughness/metallicFactor", Property::metallic, 1},
    {Of::material, "pbrMetallicRoughness/roughnessFactor", Property::roughness, 1},
    {Of::material, "extensions/KHR_materials_anisotropy/anisotropyStrength", Property::anisotropy, 1},
    {Of::material, "extensions/KHR_materials_anisotropy/anisotropyRotation", Property::anisotropyRotation, 1},
    {Of::material, "extensions/KHR_materials_clearcoat/clearcoatFactor", Property::clearcoat, 1},
    {Of::material, "extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", Property::clearcoatRoughness, 1},
    {Of::material, "extensions/KHR_materials_clearcoat/clearcoatNormalTexture/scale", Property::clearcoatNormalScale,
     1},
    {Of::material, "extensions/KHR_materials_diffuse_transmission/diffuseTransmissionFactor",
     Property::diffuseTransmission, 1},
    {Of::material, "extensions/KHR_materials_diffuse_transmission/diffuseTransmissionColorFactor",
     Property::diffuseTransmissionColor, 3},
    {Of::material, "extensions/KHR_materials_dispersion/dispersion", Property::dispersion, 1},
    {Of::material, "extensions/KHR_materials_emissive_strength/emissiveStrength", Property::emissiveStrength, 1},
    {Of::material, "extensions/KHR_materials_ior/ior", Property::ior, 1},
    {Of::material, "extensions/KHR_materials_iridescence/iridescenceFactor", Property::iridescence, 1},
    {Of::material, "extensions/KHR_materials_iridescence/iridescenceIor", Property::iridescenceIor, 1},
    {Of::material, "extensions/KHR_materials_iridescence/iridescenceThicknessMinimum", Property::iridescenceThinnest,
     1},
    {Of::material, "extensions/KHR_materials_iridescence/iridescenceThicknessMaximum", Property::iridescenceThickest,
     1},
    {Of::material, "extensions/KHR_materials_sheen/sheenColorFactor", Property::sheenColor, 3},
    {Of::material, "extensions/KHR_materials_sheen/sheenRoughnessFactor", Property::sheenRoughness, 1},
    {Of::material, "extensions/KHR_materials_specular/specularFactor", Property::specular, 1},
    {Of::material, "extensions/KHR_materials_specular/specularColorFactor", Property::specularColor, 3},
    {Of::material, "extensions/KHR_materials_transmission/transmissionFactor", Property::transmission, 1},
    {Of::material, "extensions/KHR_materials_volume/thicknessFactor", Property::thickness, 1},
    {Of::material, "extensions/KHR_materials_volume/attenuationColor", Property::attenuationColor, 3},
    {Of::material, "extensions/KHR_materials_volume/attenuationDistance", Property::attenuationDistance, 1},
}};

constexpr std::string_view transform = "/extensions/KHR_texture_transform/";
// Characters of any pointer that names a property. None of the names has what is escaped as "~0" or "~1".
constexpr size_t longest = 200;

/// Digits without leading zeros.
std::optional<size_t> indexOf(std::string_view token) {
    constexpr size_t mostDigits = 9;
    const bool digits = std::ranges::all_of(token, [](char c) { return c >= '0' && c <= '9'; });
    if (token.empty() || !digits || token.size() > mostDigits || (token.size() > 1 && token[0] == '0')) {
        return std::nullopt;
    }
    size_t index = 0;
    std::from_chars(token.data(), token.data() + token.size(), index);
    return index;
}

bool findProperty(std::string_view path, GltfPointer& found) {
    const auto* const row =
        std::ranges::find_if(rows, [&](const Row& r) { return r.of == found.of && r.path == path; });
    if (row != rows.end()) {
        found.property = row->property;
        found.components = row->components;
        return true;
    }
    const size_t at = path.find(transform);
    const auto* const texture = std::ranges::find(gltfTexturePaths, path.substr(0, at));
    if (found.of != Of::material || at == std::string_view::npos || texture == gltfTexturePaths.end()) {
        return false;
    }
    const std::string_view part = path.substr(at + transform.size());
    found.texture = static_cast<uint32_t>(texture - gltfTexturePaths.begin());
    found.property = part == "offset" ? Property::uvOffset : part == "scale" ? Property::uvScale : Property::uvRotation;
    found.components = part == "rotation" ? 1 : 2;
    return part == "offset" || part == "scale" || part == "rotation";
}

}  // namespace

std::optional<GltfPointer> parseGltfPointer(std::string_view pointer) {
    const auto* const array = std::ranges::find_if(arrays, [&](const Array& a) { return pointer.starts_with(a.path); });
    if (array == arrays.end() || pointer.size() > longest) {
        return std::nullopt;
    }
    pointer.remove_prefix(array->path.size());
    const size_t slash = std::min(pointer.find('/'), pointer.size());
    const auto index = indexOf(pointer.substr(0, slash));
    const std::string_view path = slash < pointer.size() ? pointer.substr(slash + 1) : "";
    if (!index) {
        return std::nullopt;
    }
    GltfPointer found{.of = array->of, .index = *index};
    const bool weights = path == "weights" && (found.of == Of::node || found.of == Of::mesh);
    if (weights || (found.of == Of::node && (path == "translation" || path == "rotation" || path == "scale"))) {
        found.nodePath = path;
        return found;
    }
    return findProperty(path, found) ? std::optional(found) : std::nullopt;
}

std::string_view arrayOf(GltfPointer::Of of) {
    return std::ranges::find(arrays, of, &Array::of)->name;
}

}  // namespace reflet
