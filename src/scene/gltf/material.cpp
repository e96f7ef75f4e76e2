// Converts materials of a glTF file and their textures.
#include "scene/gltf/material.h"

#include "scene/gltf/image.h"

#include <algorithm>

namespace reflet {

namespace {

constexpr float defaultIor = 1.5F;

Wrap wrapOf(int value) {
    switch (value) {
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Wrap::clamp;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Wrap::mirror;
        default:
            return Wrap::repeat;
    }
}

/// Filters that the file does not specify (-1) default to trilinear.
Sampler convertSampler(const tinygltf::Sampler& source) {
    const int min = source.minFilter;
    const bool nearest = min == TINYGLTF_TEXTURE_FILTER_NEAREST ||
                         min == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST ||
                         min == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR;
    const bool mips = min != TINYGLTF_TEXTURE_FILTER_NEAREST && min != TINYGLTF_TEXTURE_FILTER_LINEAR;
    const bool nearestMip =
        min == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST || min == TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST;
    return {.wrapU = wrapOf(source.wrapS),
            .wrapV = wrapOf(source.wrapT),
            .magLinear = source.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST,
            .minLinear = !nearest,
            .mips = mips,
            .mipLinear = mips && !nearestMip};
}

/// Textures are filtered, and colours interpolated, with rounding errors; alpha equal to the cutoff is opaque. Less
/// than half of an 8-bit step.
constexpr float cutoffTolerance = 1e-3F;

double numberOr(const tinygltf::Value& object, const std::string& name, double otherwise) {
    return object.Has(name) ? object.Get(name).GetNumberAsDouble() : otherwise;
}

double numberAt(const tinygltf::Value& object, const std::string& name, int index, double otherwise) {
    return object.Has(name) ? object.Get(name).Get(index).GetNumberAsDouble() : otherwise;
}

vec3 emissiveOf(const tinygltf::Material& source) {
    const auto& factor = source.emissiveFactor;
    const auto found = source.extensions.find("KHR_materials_emissive_strength");
    const double strength = found != source.extensions.end() ? numberOr(found->second, "emissiveStrength", 1.0) : 1.0;
    return glm::dvec3(factor[0], factor[1], factor[2]) * strength;
}

void makeUnlit(Material& material) {
    material.unlit = true;
    material.transmission = {};
    material.clearcoat = {};
    material.sheen = {};
    material.anisotropy = {};
    material.iridescence = {};
    material.diffuseTransmission = {};
}

/// KHR_materials_ior: 0 is allowed and means total reflection.
float iorOf(const tinygltf::Value& extension, const std::string& part, GltfReport& report) {
    const double ior = numberOr(extension, "ior", defaultIor);
    if (ior > 0.0 && ior < 1.0) {
        report.warn("ior", part + ".ior", "the surface will reflect as one of {}: {} is neither 0 nor at least 1",
                    defaultIor, ior);
        return defaultIor;
    }
    return static_cast<float>(ior);
}

}  // namespace

uint32_t GltfMaterials::use(int material, bool lit) {
    const int key = std::max(material, -1);
    const auto found = materials_.find({key, lit});
    if (found != materials_.end()) {
        return found->second;
    }
    scene_.materials.push_back(key < 0 ? Material{} : convert(key));
    if (!lit) {
        makeUnlit(scene_.materials.back());
    }
    uvSets_.push_back(chooseUvSets(scene_.materials.back(), fmt::format("materials[{}]", key)));
    return materials_[{key, lit}] = static_cast<uint32_t>(scene_.materials.size() - 1);
}

std::vector<uint32_t> GltfMaterials::materialsOf(int material) const {
    std::vector<uint32_t> result;
    for (const bool lit : {false, true}) {
        if (const auto found = materials_.find({material, lit}); found != materials_.end()) {
            result.push_back(found->second);
        }
    }
    return result;
}

Material GltfMaterials::convert(int material) {
    const tinygltf::Material& source = document_.materials.at(material);
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    const std::string part = fmt::format("materials[{}]", material);
    Material result;
    result.name = source.name;
    for (int c = 0; c < 4; ++c) {
        result.baseColor[c] = static_cast<float>(pbr.baseColorFactor[static_cast<size_t>(c)]);
    }
    result.metallic = static_cast<float>(pbr.metallicFactor);
    result.roughness = static_cast<float>(pbr.roughnessFactor);
    result.emissive = emissiveOf(source);
    result.normalScale = static_cast<float>(source.normalTexture.scale);
    result.occlusionStrength = static_cast<float>(source.occlusionTexture.strength);
    result.doubleSided = source.doubleSided;
    if (source.alphaMode == "MASK") {
        result.alphaCutoff = std::max(static_cast<float>(source.alphaCutoff) - cutoffTolerance, 0.0F);
    } else if (source.alphaMode == "BLEND") {
        result.alphaCutoff = blendCutoff;
        result.blended = true;
    }
    const auto slotOf = [&](const auto& info) {
        TextureSlot read;
        report_.tolerate("the texture will be left out",
                         [&] { read = slot(info.index, info.texCoord, info.extensions); });
        return read;
    };
    result.baseColorTexture = slotOf(pbr.baseColorTexture);
    result.metallicRoughnessTexture = slotOf(pbr.metallicRoughnessTexture);
    result.normalTexture = slotOf(source.normalTexture);
    result.occlusionTexture = slotOf(source.occlusionTexture);
    result.emissiveTexture = slotOf(source.emissiveTexture);
    readSpecular(result, source.extensions, part + ".extensions.");
    result.transmission = transmissionOf(source.extensions, part + ".extensions.");
    // Both sides of a sheet let light through, so both are seen: a closed one tints what is behind it twice.
    result.doubleSided =
        result.doubleSided || (result.transmission.factor > 0.0F && !(result.transmission.thickness > 0.0F));
    result.clearcoat = clearcoatOf(source.extensions);
    result.sheen = sheenOf(source.extensions);
    result.anisotropy = anisotropyOf(source.extensions);
    result.iridescence = iridescenceOf(source.extensions);
    result.diffuseTransmission = diffuseTransmissionOf(source.extensions);
    if (const auto old = source.extensions.find("KHR_materials_pbrSpecularGlossiness");
        old != source.extensions.end()) {
        readSpecularGlossiness(result, old->second);
    }
    result.unlit = source.extensions.contains("KHR_materials_unlit");
    if (result.unlit) {
        makeUnlit(result);
    }
    if (source.extras.Has("camera")) {
        result.unlit = false;
        result.camera = source.extras.Get("camera").Get<std::string>();
        result.emissive = vec3(0.0F);
        result.emissiveTexture = {};
    }
    return result;
}

void GltfMaterials::readSpecular(Material& material, const tinygltf::ExtensionMap& extensions,
                                 const std::string& part) {
    if (const auto ior = extensions.find("KHR_materials_ior"); ior != extensions.end()) {
        material.ior = iorOf(ior->second, part + ior->first, report_);
    }
    const auto found = extensions.find("KHR_materials_specular");
    if (found == extensions.end()) {
        return;
    }
    const tinygltf::Value& specular = found->second;
    material.specular = static_cast<float>(numberOr(specular, "specularFactor", 1.0));
    for (int c = 0; c < 3; ++c) {
        material.specularColor[c] = static_cast<float>(numberAt(specular, "specularColorFactor", c, 1.0));
    }
    material.specularTexture = slotOf(specular, "specularTexture");
    material.specularColorTexture = slotOf(specular, "specularColorTexture");
}

/// A texture that tinygltf keeps as plain values, because an extension refers to it.
TextureSlot GltfMaterials::slotOf(const tinygltf::Value& object, const std::string& name) {
    if (!object.Has(name)) {
        return {};
    }
    const tinygltf::Value& info = object.Get(name);
    tinygltf::ExtensionMap extensions;
    if (info.Has("extensions")) {
        extensions = info.Get("extensions").Get<tinygltf::Value::Object>();
    }
    return slot(info.Get("index").GetNumberAsInt(), static_cast<int>(numberOr(info, "texCoord", 0)), extensions);
}

TextureSlot GltfMaterials::slot(int texture, int uvSet, const tinygltf::ExtensionMap& extensions) {
    TextureSlot result;
    if (texture < 0) {
        return result;
    }
    const tinygltf::Texture& source = document_.model.textures[static_cast<size_t>(texture)];
    const int image = imageOf(source, fmt::format("textures[{}]", texture));
    if (image < 0) {
        return result;
    }
    result.image = useImage(image);
    result.sampler = useSampler(source.sampler);
    result.uvSet = static_cast<uint32_t>(std::max(uvSet, 0));
    const auto transform = extensions.find("KHR_texture_transform");
    if (transform != extensions.end()) {
        transformUv(result, transform->second);
    }
    return result;
}

int GltfMaterials::imageOf(const tinygltf::Texture& texture, const std::string& part) {
    const auto sourceOf = [&](const char* extension) {
        const auto found = texture.extensions.find(extension);
        return found != texture.extensions.end() ? static_cast<int>(numberOr(found->second, "source", -1.0)) : -1;
    };
    if (const int webp = sourceOf("EXT_texture_webp"); webp >= 0) {
        return webp;
    }
    const int ktx = sourceOf("KHR_texture_basisu");
    bool basis = false;
    if (ktx >= 0 && report_.tolerate("the texture will be left out",
                                     [&] { basis = gltfImageIsBasis(document_, static_cast<size_t>(ktx), report_); })) {
        if (!basis) {
            return ktx;
        }
    }
    if (texture.source < 0 && basis) {
        report_.warn("basis", part,
                     "the texture will be missing: images[{}] is compressed with Basis Universal, which is not "
                     "supported; convert it, for example with \"ktx transcode --target rgba8\"",
                     ktx);
    } else if (texture.source < 0 && ktx < 0) {
        report_.warn("no image", part, "the texture will be left out: it has no source image");
    }
    return texture.source;
}

void GltfMaterials::transformUv(TextureSlot& slot, const tinygltf::Value& transform) {
    const vec2 offset(numberAt(transform, "offset", 0, 0.0), numberAt(transform, "offset", 1, 0.0));
    const vec2 scale(numberAt(transform, "scale", 0, 1.0), numberAt(transform, "scale", 1, 1.0));
    slot.uvTransform = uvTransformOf(offset, numberOr(transform, "rotation", 0.0), scale);
    if (transform.Has("texCoord")) {
        slot.uvSet = static_cast<uint32_t>(std::max(transform.Get("texCoord").GetNumberAsInt(), 0));
    }
}

int32_t GltfMaterials::useImage(int image) {
    const auto found = images_.find(image);
    if (found != images_.end()) {
        return found->second;
    }
    const auto index = static_cast<size_t>(image);
    report_.use("images", index);
    report_.tolerateUntilUsed("images", index, [&] {
        const GltfImagePlace place = placeOfGltfImage(document_, index, report_);
        const auto known = places_.find(place);
        if (known == places_.end()) {
            scene_.images.push_back(decodeGltfImage(document_, index, report_));
        }
        images_[image] = known != places_.end() ? known->second : static_cast<int32_t>(scene_.images.size() - 1);
        places_[place] = images_[image];
    });
    report_.use("images", index);
    return images_[image];
}

int32_t GltfMaterials::useSampler(int sampler) {
    if (sampler < 0) {
        return -1;
    }
    const auto found = samplers_.find(sampler);
    if (found != samplers_.end()) {
        return found->second;
    }
    scene_.samplers.push_back(convertSampler(document_.model.samplers[static_cast<size_t>(sampler)]));
    return samplers_[sampler] = static_cast<int32_t>(scene_.samplers.size() - 1);
}

}  // namespace reflet
