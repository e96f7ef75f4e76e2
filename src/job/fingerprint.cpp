// Computes fingerprints. Structured bindings name every member, so that adding a member to a struct without adding it
// here does not compile.
#include "job/fingerprint.h"

#include "scene/camera_fields.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <new>
#include <type_traits>

namespace reflet {

Fingerprint::Fingerprint() : state_(XXH3_createState()) {
    if (!state_) {
        throw std::bad_alloc();
    }
    (void)XXH3_64bits_reset(state_.get());
}

void Fingerprint::Free::operator()(XXH3_state_s* state) const {
    (void)XXH3_freeState(state);
}

void Fingerprint::add(std::span<const std::byte> bytes) {
    (void)XXH3_64bits_update(state_.get(), bytes.data(), bytes.size());
}

void Fingerprint::add(std::string_view text) {
    const uint64_t size = text.size();
    add(std::as_bytes(std::span(&size, 1)));
    add(std::as_bytes(std::span(text)));
}

std::string Fingerprint::text() const {
    return fmt::format("{:016x}", XXH3_64bits_digest(state_.get()));
}

namespace {

// Only for types without padding.
template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T> || requires(T value) {
    value.length();
};

class Adder {
public:
    explicit Adder(Fingerprint& print) : print_(print) {}

    template <class... T>
    void all(const T&... values) {
        (add(values), ...);
    }

private:
    template <Plain T>
    void add(const T& value) {
        print_.add(std::as_bytes(std::span(&value, 1)));
    }

    void add(const std::string& text) { print_.add(text); }

    template <Plain T>
    void add(const std::vector<T>& values) {
        add(uint64_t(values.size()));
        print_.add(std::as_bytes(std::span(values)));
    }

    template <class T>
    void add(const std::vector<T>& values) {
        add(uint64_t(values.size()));
        for (const T& value : values) {
            add(value);
        }
    }

    template <class T>
    void add(const std::optional<T>& value) {
        add(value.has_value());
        if (value) {
            add(*value);
        }
    }

    void add(const TextureImage& image) {
        const auto& [name, width, height, rgba] = image;
        all(name, width, height, rgba);
    }

    void add(const FloatImage& image) {
        const auto& [width, height, channels, data] = image;
        all(width, height, channels, data);
    }

    void add(const Sampler& sampler) {
        const auto& [wrapU, wrapV, magLinear, minLinear, mips, mipLinear] = sampler;
        all(wrapU, wrapV, magLinear, minLinear, mips, mipLinear);
    }

    void add(const TextureSlot& slot) {
        const auto& [image, sampler, uvSet, uvTransform] = slot;
        all(image, sampler, uvSet, uvTransform[0], uvTransform[1]);
    }

    void add(const Material& material) {
        const auto& [name, baseColor, metallic, roughness, emissive, normalScale, occlusionStrength, alphaCutoff,
                     blended, doubleSided, unlit, ior, specular, specularColor, camera, baseColorTexture,
                     metallicRoughnessTexture, normalTexture, occlusionTexture, emissiveTexture, specularTexture,
                     specularColorTexture, transmission, clearcoat, sheen, anisotropy, iridescence,
                     diffuseTransmission] = material;
        all(name, baseColor, metallic, roughness, emissive, normalScale, occlusionStrength, alphaCutoff, blended,
            doubleSided, unlit, ior, specular, specularColor, camera, baseColorTexture, metallicRoughnessTexture,
            normalTexture, occlusionTexture, emissiveTexture, specularTexture, specularColorTexture, transmission,
            clearcoat, sheen, anisotropy, iridescence, diffuseTransmission);
    }

    void add(const Transmission& transmission) {
        const auto& [factor, thickness, attenuationColor, attenuationDistance, dispersion, texture, thicknessTexture] =
            transmission;
        all(factor, thickness, attenuationColor, attenuationDistance, dispersion, texture, thicknessTexture);
    }

    void add(const Clearcoat& clearcoat) {
        const auto& [factor, roughness, normalScale, texture, roughnessTexture, normalTexture] = clearcoat;
        all(factor, roughness, normalScale, texture, roughnessTexture, normalTexture);
    }

    void add(const Sheen& sheen) {
        const auto& [color, roughness, colorTexture, roughnessTexture] = sheen;
        all(color, roughness, colorTexture, roughnessTexture);
    }

    void add(const Anisotropy& anisotropy) {
        const auto& [strength, rotation, texture] = anisotropy;
        all(strength, rotation, texture);
    }

    void add(const Iridescence& iridescence) {
        const auto& [factor, ior, thinnest, thickest, texture, thicknessTexture] = iridescence;
        all(factor, ior, thinnest, thickest, texture, thicknessTexture);
    }

    void add(const DiffuseTransmission& transmission) {
        const auto& [factor, color, texture, colorTexture] = transmission;
        all(factor, color, texture, colorTexture);
    }

    void add(const VertexAttributes& vertex) {
        const auto& [normal, tangent, uv0, uv1, color] = vertex;
        all(normal, tangent, uv0, uv1, color);
    }

    void add(const Mesh& mesh) {
        const auto& [name, positions, attributes, skin, jointWeights, morph, indices, material, bounds, outward,
                     width] = mesh;
        (void)bounds;  // follows from the positions
        (void)width;
        (void)outward;  // nor are points and lines otherwise than their positions
        all(name, positions, attributes, skin, jointWeights, morph.vertices, morph.deltas, indices, material);
    }

    void add(const Morph::Range& range) {
        const auto& [first, count] = range;
        all(first, count);
    }

    void add(const MorphDelta& delta) {
        const auto& [target, position, normal, tangent] = delta;
        all(target, position, normal, tangent);
    }

    void add(const VertexSkin& vertex) {
        const auto& [first, count] = vertex;
        all(first, count);
    }

    void add(const JointWeight& moved) {
        const auto& [joint, weight] = moved;
        all(joint, weight);
    }

    void add(const Node& node) {
        const auto& [parent, translation, rotation, scale, matrix] = node;
        all(parent, translation, rotation, scale, matrix);
    }

    void add(const Channel& channel) {
        const auto& [node, target, interpolation, times, values, weights] = channel;
        all(node, target, interpolation, times, values, weights);
    }

    void add(const Animation& animation) {
        const auto& [name, channels, properties] = animation;
        all(name, channels, properties);
    }

    void add(const PropertyChannel& channel) {
        const auto& [property, texture, targets, keys] = channel;
        all(property, texture, targets, keys);
    }

    void add(const Skin& skin) {
        const auto& [joints, inverseBind, shownBy] = skin;
        all(joints, inverseBind, shownBy);
    }

    void add(const Instance& instance) {
        const auto& [name, mesh, objectToWorld, node, skin, weights, objectToNode] = instance;
        all(name, mesh, objectToWorld, node, skin, weights, objectToNode);
    }

    // `aims` says what others may do with the target.
    void add(const Camera& camera) {
        all(camera.name, camera.node, camera.focus);
        for (const CameraField& field : cameraFields()) {
            std::visit([&](const auto member) { add(camera.*member); }, field.member);
        }
    }

    void add(const FocusTarget& target) {
        const auto& [kind, distance, point, node, weight] = target;
        all(kind, distance, point, node, weight);
    }

    void add(const Sun& sun) {
        const auto& [direction, irradiance, angularDiameter, node] = sun;
        all(direction, irradiance, angularDiameter, node);
    }

    void add(const Lamp& lamp) {
        const auto& [name, type, position, direction, intensity, range, innerAngle, outerAngle, radius, node] = lamp;
        all(name, type, position, direction, intensity, range, innerAngle, outerAngle, radius, node);
    }

    void add(const Environment& environment) {
        const auto& [radiance, image, imageFile, intensity, rotation] = environment;
        (void)imageFile;
        all(radiance, image != nullptr, intensity, rotation);
        if (image != nullptr) {
            add(*image);
        }
    }

    Fingerprint& print_;
};

}  // namespace

void addTo(Fingerprint& print, const Scene& scene) {
    const auto& [name, origin, fromFile, images, samplers, materials, meshes, instances, lamps, cameras, sun,
                 environment, nodes, animations, resting, skins, extensions, variants, clips] = scene;
    (void)extensions;
    (void)origin;    // of coordinates that are not in the picture
    (void)fromFile;  // it does not change radiance
    (void)variants;  // names alone
    (void)clips;
    Adder(print).all(fingerprintVersion, name, images, samplers, materials, meshes, instances, lamps, cameras, sun,
                     environment, nodes, animations, resting, skins);
}

void addTo(Fingerprint& print, const View& view) {
    const auto& [camera, sun, environment, background, time, lampRadius, lampsOff, probes, mirrors, hasDefaultSun,
                 origin] = view;
    (void)origin;
    (void)probes;
    (void)mirrors;
    Adder(print).all(fingerprintVersion, camera, sun, environment, background.mode, background.color, time, lampRadius,
                     lampsOff, hasDefaultSun);
}

void addTo(Fingerprint& print, const ReferenceOptions& options) {
    const auto& [bounces, samples, firstSample, noise, filter, diffuse, visibleOnly, lambertOnly, lampShadows,
                 ambientOcclusion, aoRadius, aoFalloff, pinhole, clamp, seed, threads] = options;
    (void)threads;
    Adder(print).all(fingerprintVersion, bounces, samples, noise, filter, diffuse, visibleOnly, lambertOnly,
                     lampShadows, ambientOcclusion, aoRadius, aoFalloff, pinhole, seed);
    if (clamp > 0.0F) {  // what was stored before there was one stays valid
        Adder(print).all(clamp);
    }
    if (firstSample > 0) {
        Adder(print).all(firstSample);
    }
}

}  // namespace reflet
