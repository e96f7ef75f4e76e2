// Applies the values of animated properties.
#include "scene/property.h"

#include "scene/environment.h"
#include "scene/sample_channel.h"

#include <algorithm>
#include <array>
#include <limits>

namespace reflet {

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float sharpEdge = 0.99F;  // of a cone's outer angle
constexpr float smallest = 1e-6F;
constexpr auto brightest = static_cast<float>(largestRadiance);
constexpr float widest = 3.1415F;     // field of view [rad]
constexpr float mostPassed = 0.999F;  // so that a surface that ever reflects is not taken for one that never does

/// A property of a material that is a member of it.
struct Rule {
    Property property;
    int components;
    float least;
    float most;
    float* (*member)(Material& m);
};

constexpr std::array<Rule, 27> rules{{
    {Property::baseColor, 4, 0, 1, [](Material& m) { return &m.baseColor.x; }},
    {Property::metallic, 1, 0, 1, [](Material& m) { return &m.metallic; }},
    {Property::roughness, 1, 0, 1, [](Material& m) { return &m.roughness; }},
    {Property::normalScale, 1, -infinite, infinite, [](Material& m) { return &m.normalScale; }},
    {Property::occlusionStrength, 1, 0, 1, [](Material& m) { return &m.occlusionStrength; }},
    {Property::alphaCutoff, 1, 0, infinite, [](Material& m) { return &m.alphaCutoff; }},
    {Property::specular, 1, 0, 1, [](Material& m) { return &m.specular; }},
    {Property::specularColor, 3, 0, infinite, [](Material& m) { return &m.specularColor.x; }},
    {Property::transmission, 1, 0, 1, [](Material& m) { return &m.transmission.factor; }},
    {Property::thickness, 1, 0, infinite, [](Material& m) { return &m.transmission.thickness; }},
    {Property::attenuationColor, 3, 0, 1, [](Material& m) { return &m.transmission.attenuationColor.x; }},
    {Property::attenuationDistance, 1, smallest, infinite,
     [](Material& m) { return &m.transmission.attenuationDistance; }},
    {Property::dispersion, 1, 0, infinite, [](Material& m) { return &m.transmission.dispersion; }},
    {Property::clearcoat, 1, 0, 1, [](Material& m) { return &m.clearcoat.factor; }},
    {Property::clearcoatRoughness, 1, 0, 1, [](Material& m) { return &m.clearcoat.roughness; }},
    {Property::clearcoatNormalScale, 1, -infinite, infinite, [](Material& m) { return &m.clearcoat.normalScale; }},
    {Property::sheenColor, 3, 0, 1, [](Material& m) { return &m.sheen.color.x; }},
    {Property::sheenRoughness, 1, 0, 1, [](Material& m) { return &m.sheen.roughness; }},
    {Property::anisotropy, 1, 0, 1, [](Material& m) { return &m.anisotropy.strength; }},
    {Property::anisotropyRotation, 1, -infinite, infinite, [](Material& m) { return &m.anisotropy.rotation; }},
    {Property::iridescence, 1, 0, 1, [](Material& m) { return &m.iridescence.factor; }},
    {Property::iridescenceIor, 1, 1, infinite, [](Material& m) { return &m.iridescence.ior; }},
    {Property::iridescenceThinnest, 1, 0, infinite, [](Material& m) { return &m.iridescence.thinnest; }},
    {Property::iridescenceThickest, 1, 0, infinite, [](Material& m) { return &m.iridescence.thickest; }},
    {Property::diffuseTransmission, 1, 0, 1, [](Material& m) { return &m.diffuseTransmission.factor; }},
    {Property::diffuseTransmissionColor, 3, 0, 1, [](Material& m) { return &m.diffuseTransmission.color.x; }},
    {Property::ior, 1, 0, infinite, [](Material& m) { return &m.ior; }},
}};

// The parts of what the scene has as one value.
struct Emission {
    vec3 color{0.0F};
    float strength = 1.0F;
};
struct UvPlace {
    vec2 offset{0.0F};
    float rotation = 0.0F;
    vec2 scale{1.0F};
};

class Applied {
public:
    explicit Applied(const Scene& scene) : scene_(scene) {}

    void add(const PropertyChannel& channel, const vec4& value) {
        for (const uint32_t target : channel.targets) {
            if (channel.property < Property::lightColor) {
                addToMaterial(channel, target, value);
            } else {
                addToNode(channel.property, static_cast<int32_t>(target), value);
            }
        }
    }

    AnimatedProperties finish() {
        for (const auto& [material, emission] : emissions_) {
            result_.materials.at(material).emissive = emission.color * emission.strength;
        }
        for (const auto& [place, uv] : uvs_) {
            materialTextures(result_.materials.at(place.first)).at(place.second)->uvTransform =
                uvTransformOf(uv.offset, uv.rotation, uv.scale);
        }
        for (const auto& [node, light] : lights_) {
            result_.lights.at(node).now.intensity = glm::min(light.color * light.strength, vec3(brightest));
        }
        for (auto& [node, light] : result_.lights) {
            Lamp& lamp = light.now;
            if (!(lamp.innerAngle < lamp.outerAngle)) {
                lamp.outerAngle = std::max(lamp.outerAngle, 1e-3F);
                lamp.innerAngle = sharpEdge * lamp.outerAngle;
            }
        }
        for (auto& [node, lens] : result_.lenses) {
            lens.now.far = std::max(lens.now.far, 1.001F * lens.now.near);
        }
        return std::move(result_);
    }

private:
    void addToMaterial(const PropertyChannel& channel, uint32_t index, const vec4& value) {
        Material& m = result_.materials.try_emplace(index, scene_.materials.at(index)).first->second;
        const auto rule = std::ranges::find(rules, channel.property, &Rule::property);
        if (rule != rules.end()) {
            for (int c = 0; c < rule->components; ++c) {
                rule->member(m)[c] = std::clamp(value[c], rule->least, rule->most);
            }
            m.ior = m.ior > 0.0F ? std::max(m.ior, 1.0F) : 0.0F;
        } else if (channel.property == Property::emissiveFactor) {
            emissions_[index].color = glm::clamp(vec3(value), 0.0F, 1.0F);
        } else if (channel.property == Property::emissiveStrength) {
            emissions_[index].strength = std::clamp(value.x, 0.0F, brightest);
        } else if (channel.property == Property::uvOffset) {
            uvs_[{index, channel.texture}].offset = vec2(value);
        } else if (channel.property == Property::uvRotation) {
            uvs_[{index, channel.texture}].rotation = value.x;
        } else if (channel.property == Property::uvScale) {
            uvs_[{index, channel.texture}].scale = vec2(value);
        }
    }

    Camera& lensOf(int32_t node) {
        const auto [found, isNew] = result_.lenses.try_emplace(node);
        const auto source = std::ranges::find(scene_.cameras, node, &Camera::node);
        if (isNew && source != scene_.cameras.end()) {
            found->second = {*source, *source};
        }
        return found->second.now;
    }

    Lamp& lampOf(int32_t node) {
        const auto [found, isNew] = result_.lights.try_emplace(node);
        const auto source = std::ranges::find(scene_.lamps, node, &Lamp::node);
        if (isNew && source != scene_.lamps.end()) {
            found->second = {*source, *source};
        } else if (isNew && scene_.sun && scene_.sun->node == node) {
            found->second.resting.intensity = scene_.sun->irradiance;
        }
        return found->second.now;
    }

    void addToNode(Property property, int32_t node, const vec4& value) {
        switch (property) {
            case Property::lightColor:
                lampOf(node);
                lights_[node].color = glm::clamp(vec3(value), 0.0F, brightest);
                break;
            case Property::lightIntensity:
                lampOf(node);
                lights_[node].strength = std::clamp(value.x, 0.0F, brightest);
                break;
            case Property::lightRange:
                lampOf(node).range = std::max(value.x, smallest);
                break;
            case Property::innerCone:
                lampOf(node).innerAngle = std::clamp(value.x, 0.0F, glm::half_pi<float>());
                break;
            case Property::outerCone:
                lampOf(node).outerAngle = std::clamp(value.x, 0.0F, glm::half_pi<float>());
                break;
            case Property::fovY:
                lensOf(node).fovY = std::clamp(value.x, 1e-4F, widest);
                break;
            case Property::near:
                lensOf(node).near = std::max(value.x, lensOf(node).orthographicHeight > 0.0F ? 1e-3F : smallest);
                break;
            case Property::far:
                lensOf(node).far = std::max(value.x, smallest);
                break;
            case Property::orthographicHeight:
                lensOf(node).orthographicHeight = std::max(value.x, smallest);
                break;
            default:
                result_.visible[node] = value.x != 0.0F;
        }
    }

    const Scene& scene_;
    AnimatedProperties result_;
    std::map<uint32_t, Emission> emissions_;
    std::map<std::pair<uint32_t, uint32_t>, UvPlace> uvs_;  ///< by material and texture
    std::map<int32_t, Emission> lights_;
};

/// Of all keys the largest of each component; of reflectances, the key that differs most from the default.
vec4 largestOf(const PropertyChannel& channel) {
    const bool spline = channel.keys.interpolation == Interpolation::cubicSpline;
    const bool reflectance = channel.property == Property::ior || channel.property == Property::specular ||
                             channel.property == Property::specularColor;
    const vec3 usual(channel.property == Property::ior ? Material{}.ior : 1.0F);
    vec4 largest = channel.keys.values.at(spline ? 1 : 0);
    float least = largest.x;
    for (size_t i = spline ? 1 : 0; i < channel.keys.values.size(); i += spline ? 3 : 1) {
        const vec4& value = channel.keys.values[i];
        least = std::min(least, value.x);
        if (!reflectance) {
            largest = glm::max(largest, value);
        } else if (glm::distance(vec3(value), usual) > glm::distance(vec3(largest), usual)) {
            largest = value;
        }
    }
    const bool varies = channel.property == Property::transmission && least < 1.0F;
    return varies ? glm::min(largest, mostPassed) : largest;
}

template <class Use>
void eachChannel(const Scene& scene, const Use& use) {
    for (const PropertyChannel& channel : scene.resting) {
        use(channel);
    }
    for (const Animation& animation : scene.animations) {
        for (const PropertyChannel& channel : animation.properties) {
            use(channel);
        }
    }
}

}  // namespace

AnimatedProperties animatedProperties(const Scene& scene, const std::function<vec4(const PropertyChannel&)>& valueOf) {
    Applied applied(scene);
    eachChannel(scene, [&](const PropertyChannel& channel) { applied.add(channel, valueOf(channel)); });
    return applied.finish();
}

void applyLargestProperties(Scene& scene) {
    const AnimatedProperties first = animatedProperties(
        scene, [](const PropertyChannel& channel) { return vec4(sampleChannel(channel.keys, 0.0)); });
    AnimatedProperties largest = animatedProperties(scene, largestOf);
    for (auto& [index, material] : largest.materials) {
        scene.materials[index] = std::move(material);
    }
    for (Lamp& lamp : scene.lamps) {
        if (const auto found = largest.lights.find(lamp.node); found != largest.lights.end()) {
            lamp = found->second.now;
        }
    }
    if (scene.sun && largest.lights.contains(scene.sun->node)) {
        scene.sun->irradiance = largest.lights.at(scene.sun->node).now.intensity;
    }
    for (Camera& camera : scene.cameras) {
        if (const auto found = first.lenses.find(camera.node); found != first.lenses.end()) {
            camera = found->second.now;
        }
    }
}

bool hasAnimatedMaterials(const Scene& scene) {
    bool result = false;
    eachChannel(scene, [&](const PropertyChannel& channel) {
        result = result || (channel.property < Property::lightColor && !channel.targets.empty());
    });
    return result;
}

std::vector<bool> materialsWithAnimated(const Scene& scene, Property property) {
    std::vector<bool> result(scene.materials.size(), false);
    eachChannel(scene, [&](const PropertyChannel& channel) {
        for (const uint32_t target : channel.property == property ? channel.targets : std::vector<uint32_t>{}) {
            result.at(target) = true;
        }
    });
    return result;
}

std::vector<bool> nodesThatAppear(const Scene& scene) {
    std::vector<bool> result;
    eachChannel(scene, [&](const PropertyChannel& channel) {
        if (channel.property == Property::visible) {
            result.resize(scene.nodes.size(), false);
            for (const uint32_t node : channel.targets) {
                result.at(node) = true;
            }
        }
    });
    for (size_t i = 0; i < result.size(); ++i) {  // parents come first
        const int32_t parent = scene.nodes[i].parent;
        result[i] = result[i] || (parent >= 0 && result[static_cast<size_t>(parent)]);
    }
    return result;
}

}  // namespace reflet
