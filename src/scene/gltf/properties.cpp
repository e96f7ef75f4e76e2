// Connects the animated properties of a glTF file with what they change in the scene.
#include "scene/gltf/properties.h"

#include "scene/gltf/texture_paths.h"
#include "scene/property.h"

#include <algorithm>
#include <string_view>

namespace reflet {

namespace {

constexpr uint64_t bytesPerTarget = 256;  // with what it takes to evaluate it
constexpr float cutoffTolerance = 1e-3F;  // as that of alpha cutoffs that stand still

bool isEmission(Property property) {
    return property == Property::emissiveFactor || property == Property::emissiveStrength;
}

bool isUv(Property property) {
    return property >= Property::uvOffset && property <= Property::uvScale;
}

/// Whether the property changes what is seen of the material.
bool isUsedBy(const Material& m, const PropertyChannel& channel, const tinygltf::Material& source) {
    const Property property = channel.property;
    if (isUv(property)) {
        return materialTextures(m).at(channel.texture)->image >= 0;
    }
    if (property == Property::alphaCutoff) {
        return source.alphaMode == "MASK";
    }
    if (isEmission(property)) {
        return m.camera.empty();
    }
    if (source.extensions.contains("KHR_materials_pbrSpecularGlossiness") &&
        (property <= Property::roughness || (property >= Property::ior && property <= Property::specularColor))) {
        return false;
    }
    return !m.unlit || property < Property::ior;
}

PropertyChannel restingAt(const PropertyChannel& animated, Property property, const vec4& value) {
    PropertyChannel part{.property = property, .texture = animated.texture, .targets = animated.targets, .keys = {}};
    part.keys.target = Channel::Target::property;
    part.keys.interpolation = Interpolation::step;
    part.keys.times = {0.0F};
    part.keys.values = {value};
    return part;
}

/// An empty value if there is none.
tinygltf::Value childOf(const tinygltf::Value& object, const std::string& name) {
    return object.IsObject() ? object.Get(name) : tinygltf::Value{};
}

/// KHR_texture_transform of a texture of the material; an empty value: it has none.
tinygltf::Value transformOf(const tinygltf::Material& source, uint32_t texture) {
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    const tinygltf::ExtensionMap* core[] = {&pbr.baseColorTexture.extensions, &pbr.metallicRoughnessTexture.extensions,
                                            &source.normalTexture.extensions, &source.occlusionTexture.extensions,
                                            &source.emissiveTexture.extensions};
    const std::string name = "KHR_texture_transform";
    if (texture < std::size(core)) {
        const auto found = core[texture]->find(name);
        return found != core[texture]->end() ? found->second : tinygltf::Value{};
    }
    const std::string_view path = gltfTexturePaths.at(texture);  // extensions/EXTENSION/TEXTURE
    const size_t first = path.find('/') + 1;
    const size_t last = path.rfind('/');
    const auto extension = source.extensions.find(std::string(path.substr(first, last - first)));
    if (extension == source.extensions.end()) {
        return {};
    }
    return childOf(childOf(childOf(extension->second, std::string(path.substr(last + 1))), "extensions"), name);
}

float numberAt(const tinygltf::Value& list, int index, float otherwise) {
    return list.IsArray() ? static_cast<float>(list.Get(index).GetNumberAsDouble()) : otherwise;
}

class Binder {
public:
    Binder(const GltfDocument& document, const GltfMaterials& materials, const GltfPlacement& placement, Scene& scene)
        : document_(document), materials_(materials), placement_(placement), scene_(scene) {}

    void bind(const GltfOpenProperty& open) {
        PropertyChannel& channel = scene_.animations[open.animation].properties[open.property];
        if (open.of == GltfPointer::Of::material) {
            bindMaterial(channel, static_cast<int>(open.index));
            return;
        }
        const auto& placed = open.of == GltfPointer::Of::camera ? placement_.cameras : placement_.lights;
        const auto [first, last] = placed.equal_range(static_cast<int>(open.index));
        std::for_each(first, last,
                      [&](const auto& at) { channel.targets.push_back(static_cast<uint32_t>(at.second)); });
        if (channel.property == Property::lightColor || channel.property == Property::lightIntensity) {
            const tinygltf::Light& light = document_.model.lights[open.index];
            rest(channel, Property::lightColor, vec4(vectorOr(light.color, glm::dvec3(1.0)), 0.0));
            rest(channel, Property::lightIntensity, vec4(light.intensity));
        }
    }

private:
    void rest(const PropertyChannel& channel, Property property, const vec4& value) {
        if (!channel.targets.empty()) {
            scene_.resting.push_back(restingAt(channel, property, value));
        }
    }

    void bindMaterial(PropertyChannel& channel, int index) {
        const auto source = document_.materials.find(index);
        if (source == document_.materials.end()) {
            return;  // no mesh has it
        }
        for (const uint32_t material : materials_.materialsOf(index)) {
            if (isUsedBy(scene_.materials[material], channel, source->second)) {
                channel.targets.push_back(material);
            }
        }
        if (channel.property == Property::alphaCutoff) {
            const bool spline = channel.keys.interpolation == Interpolation::cubicSpline;
            for (size_t i = spline ? 1 : 0; i < channel.keys.values.size(); i += spline ? 3 : 1) {
                channel.keys.values[i] -= cutoffTolerance;
            }
        } else if (isEmission(channel.property)) {
            const auto& factor = source->second.emissiveFactor;
            const auto strength = source->second.extensions.find("KHR_materials_emissive_strength");
            const bool has = strength != source->second.extensions.end() && strength->second.Has("emissiveStrength");
            rest(channel, Property::emissiveFactor, vec4(factor[0], factor[1], factor[2], 0.0));
            rest(channel, Property::emissiveStrength,
                 vec4(has ? strength->second.Get("emissiveStrength").GetNumberAsDouble() : 1.0));
        } else if (isUv(channel.property)) {
            const tinygltf::Value transform = transformOf(source->second, channel.texture);
            const tinygltf::Value offset = childOf(transform, "offset");
            const tinygltf::Value scale = childOf(transform, "scale");
            rest(channel, Property::uvOffset, vec4(numberAt(offset, 0, 0.0F), numberAt(offset, 1, 0.0F), 0, 0));
            rest(channel, Property::uvRotation,
                 vec4(transform.Has("rotation") ? transform.Get("rotation").GetNumberAsDouble() : 0.0));
            rest(channel, Property::uvScale, vec4(numberAt(scale, 0, 1.0F), numberAt(scale, 1, 1.0F), 0, 0));
        }
    }

    const GltfDocument& document_;
    const GltfMaterials& materials_;
    const GltfPlacement& placement_;
    Scene& scene_;
};

}  // namespace

void bindGltfProperties(const GltfDocument& document, const GltfMaterials& materials, const GltfPlacement& placement,
                        Scene& scene, GltfReport& report) {
    if (placement.open.empty()) {
        return;
    }
    Binder binder(document, materials, placement, scene);
    for (const GltfOpenProperty& open : placement.open) {
        binder.bind(open);
        const PropertyChannel& bound = scene.animations[open.animation].properties[open.property];
        report.charge("animations", bound.targets.size() * bytesPerTarget);
    }
    for (Animation& animation : scene.animations) {
        std::erase_if(animation.properties, [](const PropertyChannel& channel) { return channel.targets.empty(); });
    }
    std::erase_if(scene.animations, [](const Animation& a) { return a.channels.empty() && a.properties.empty(); });
    applyLargestProperties(scene);
    for (Material& m : scene.materials) {
        // As a sheet that stands still, which is seen from both sides.
        m.doubleSided = m.doubleSided || (m.transmission.factor > 0.0F && !(m.transmission.thickness > 0.0F));
    }
}

}  // namespace reflet
