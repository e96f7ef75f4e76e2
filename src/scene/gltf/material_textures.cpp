// Sets of texture coordinates, and materials of KHR_materials_pbrSpecularGlossiness.
#include "scene/gltf/material.h"

#include "scene/gltf/texture_paths.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

namespace reflet {

namespace {

constexpr float reflectsAll = 0.0F;  // KHR_materials_ior: reflectance at normal incidence is the specular colour itself

}  // namespace

/// The first two sets of the list, at their own place if they are 0 and 1.
std::array<uint32_t, 2> GltfMaterials::chooseUvSets(Material& material, const std::string& part) {
    const auto slots = materialTextures(material);
    static_assert(std::tuple_size_v<decltype(materialTextures(material))> == gltfTexturePaths.size());
    std::vector<uint32_t> kept;
    const auto keep = [&](uint32_t set) {
        if (kept.size() < 2 && std::ranges::find(kept, set) == kept.end()) {
            kept.push_back(set);
        }
    };
    if (material.anisotropy.strength > 0.0F && material.anisotropy.texture.image < 0) {
        keep(0);  // its direction is that of the first set
    }
    for (const TextureSlot* slot : slots) {
        if (slot->image >= 0) {
            keep(slot->uvSet);
        }
    }
    std::array<uint32_t, 2> sets{0, 1};
    for (const uint32_t set : kept) {
        if (set > 1) {
            *std::ranges::find_if(sets, [&](uint32_t s) { return std::ranges::find(kept, s) == kept.end(); }) = set;
        }
    }
    std::string others;
    for (size_t i = 0; i < slots.size(); ++i) {
        const auto place = static_cast<uint32_t>(std::ranges::find(sets, slots[i]->uvSet) - sets.begin());
        if (slots[i]->image >= 0 && place == sets.size()) {
            const std::string_view path = gltfTexturePaths.at(i);
            others += fmt::format("{}{} (TEXCOORD_{})", others.empty() ? "" : ", ", path.substr(path.rfind('/') + 1),
                                  slots[i]->uvSet);
        }
        slots[i]->uvSet = place % sets.size();
    }
    if (!others.empty()) {
        report_.warn(
            "uv sets", part,
            "{} will be drawn with TEXCOORD_{}: a material may have two sets, here TEXCOORD_{} and TEXCOORD_{}", others,
            sets[0], sets[0], sets[1]);
    }
    return sets;
}

/// The model of this extension is a dielectric whose reflectance at normal incidence is the specular colour.
void GltfMaterials::readSpecularGlossiness(Material& material, const tinygltf::Value& extension) {
    const auto number = [&](const char* name, int index, double otherwise) {
        return static_cast<float>(extension.Has(name) ? extension.Get(name).Get(index).GetNumberAsDouble() : otherwise);
    };
    for (int c = 0; c < 4; ++c) {
        material.baseColor[c] = number("diffuseFactor", c, 1.0);
    }
    for (int c = 0; c < 3; ++c) {
        material.specularColor[c] = number("specularFactor", c, 1.0);
    }
    const auto glossiness = static_cast<float>(
        extension.Has("glossinessFactor") ? extension.Get("glossinessFactor").GetNumberAsDouble() : 1.0);
    material.metallic = 0.0F;
    material.roughness = 1.0F - glossiness;
    material.ior = reflectsAll;
    material.specular = 1.0F;
    material.specularTexture = {};
    material.metallicRoughnessTexture = {};
    material.baseColorTexture = slotOf(extension, "diffuseTexture");
    material.specularColorTexture = slotOf(extension, "specularGlossinessTexture");
    if (material.specularColorTexture.image >= 0) {
        material.metallicRoughnessTexture = material.specularColorTexture;
        material.metallicRoughnessTexture.image = convertGlossiness(material.specularColorTexture.image, glossiness);
        material.roughness = 1.0F;
    }
}

/// Roughness in green; glossiness is in alpha, as a share of the factor.
int32_t GltfMaterials::convertGlossiness(int32_t image, float glossiness) {
    const auto [found, isNew] =
        glossiness_.try_emplace({image, glossiness}, static_cast<int32_t>(scene_.images.size()));
    if (isNew) {
        TextureImage rough = scene_.images[static_cast<size_t>(image)];
        report_.charge("images", rough.rgba.size());
        rough.name += " roughness";
        for (size_t i = 0; i + 3 < rough.rgba.size(); i += 4) {
            const float gloss = glossiness * static_cast<float>(rough.rgba[i + 3]);
            rough.rgba[i] = 0;
            rough.rgba[i + 1] = static_cast<uint8_t>(std::lround(std::clamp(255.0F - gloss, 0.0F, 255.0F)));
            rough.rgba[i + 2] = 0;
            rough.rgba[i + 3] = 255;
        }
        scene_.images.push_back(std::move(rough));
    }
    return found->second;
}

}  // namespace reflet
