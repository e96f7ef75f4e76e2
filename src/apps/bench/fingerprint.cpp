// Fingerprints. Structured bindings name every member: one that is added to a struct must be added here, or it will not
// compile.
#include "apps/bench/fingerprint.h"

#include <spdlog/fmt/fmt.h>

#include <memory>
#include <type_traits>

namespace reflet {

void Fingerprint::add(std::span<const std::byte> bytes) {
    constexpr uint64_t prime = 0x100000001B3ULL;
    for (const std::byte byte : bytes) {
        hash_ = (hash_ ^ static_cast<uint64_t>(byte)) * prime;
    }
}

void Fingerprint::add(std::string_view text) {
    const uint64_t size = text.size();
    add(std::as_bytes(std::span(&size, 1)));
    add(std::as_bytes(std::span(text)));
}

std::string Fingerprint::text() const {
    return fmt::format("{:016x}", hash_);
}

namespace {

// What has no padding.
template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T> || requires(T value) {
    value.length();
};

template <Plain T>
requires(!std::is_same_v<T, std::string>) void addTo(Fingerprint& print, const T& value) {
    print.add(std::as_bytes(std::span(&value, 1)));
}

void addTo(Fingerprint& print, const std::string& text) {
    print.add(text);
}

template <class T>
void addTo(Fingerprint& print, const std::vector<T>& values);
template <class T>
void addTo(Fingerprint& print, const std::optional<T>& value);

template <class... T>
void addAll(Fingerprint& print, const T&... values) {
    (addTo(print, values), ...);
}

void addTo(Fingerprint& print, const Image& image) {
    const auto& [name, width, height, rgba] = image;
    addAll(print, name, width, height, rgba);
}

void addTo(Fingerprint& print, const FloatImage& image) {
    const auto& [width, height, channels, data] = image;
    addAll(print, width, height, channels, data);
}

void addTo(Fingerprint& print, const Sampler& sampler) {
    const auto& [wrapU, wrapV, magLinear, minLinear, mips, mipLinear] = sampler;
    addAll(print, wrapU, wrapV, magLinear, minLinear, mips, mipLinear);
}

void addTo(Fingerprint& print, const TextureSlot& slot) {
    const auto& [image, sampler, uvSet, uvTransform] = slot;
    addAll(print, image, sampler, uvSet, uvTransform[0], uvTransform[1]);
}

void addTo(Fingerprint& print, const Material& material) {
    const auto& [name, baseColor, metallic, roughness, emissive, normalScale, occlusionStrength, alphaCutoff,
                 doubleSided, camera, baseColorTexture, metallicRoughnessTexture, normalTexture, occlusionTexture,
                 emissiveTexture] = material;
    addAll(print, name, baseColor, metallic, roughness, emissive, normalScale, occlusionStrength, alphaCutoff,
           doubleSided, camera, baseColorTexture, metallicRoughnessTexture, normalTexture, occlusionTexture,
           emissiveTexture);
}

void addTo(Fingerprint& print, const VertexAttributes& vertex) {
    const auto& [normal, tangent, uv0, uv1, color] = vertex;
    addAll(print, normal, tangent, uv0, uv1, color);
}

void addTo(Fingerprint& print, const Mesh& mesh) {
    const auto& [name, positions, attributes, indices, material, bounds] = mesh;  // bounds are those of the positions
    (void)bounds;
    addAll(print, name, positions, attributes, indices, material);
}

void addTo(Fingerprint& print, const Instance& instance) {
    const auto& [name, mesh, objectToWorld] = instance;
    addAll(print, name, mesh, objectToWorld);
}

void addTo(Fingerprint& print, const Camera& camera) {
    const auto& [name, position, target, up, fovY, near, orthographicHeight, far] = camera;
    addAll(print, name, position, target, up, fovY, near, orthographicHeight, far);
}

void addTo(Fingerprint& print, const Sun& sun) {
    const auto& [direction, irradiance, angularDiameter] = sun;
    addAll(print, direction, irradiance, angularDiameter);
}

void addTo(Fingerprint& print, const Lamp& lamp) {
    const auto& [name, type, position, direction, intensity, range, innerAngle, outerAngle, radius] = lamp;
    addAll(print, name, type, position, direction, intensity, range, innerAngle, outerAngle, radius);
}

void addTo(Fingerprint& print, const Environment& environment) {
    const auto& [radiance, image, intensity, rotation] = environment;
    addAll(print, radiance, image != nullptr, intensity, rotation);
    if (image != nullptr) {
        addTo(print, *image);
    }
}

template <class T>
void addTo(Fingerprint& print, const std::vector<T>& values) {
    addTo(print, uint64_t(values.size()));
    for (const T& value : values) {
        addTo(print, value);
    }
}

template <class T>
void addTo(Fingerprint& print, const std::optional<T>& value) {
    addTo(print, value.has_value());
    if (value) {
        addTo(print, *value);
    }
}

}  // namespace

void addTo(Fingerprint& print, const Scene& scene) {
    const auto& [name, images, samplers, materials, meshes, instances, lamps, cameras, sun, environment] = scene;
    addAll(print, name, images, samplers, materials, meshes, instances, lamps, cameras, sun, environment);
}

void addTo(Fingerprint& print, const View& view) {
    const auto& [camera, sun, environment, lampRadius, probes, mirrors, sunStandsIn] = view;
    (void)probes;
    (void)mirrors;
    addAll(print, camera, sun, environment, lampRadius, sunStandsIn);
}

void addTo(Fingerprint& print, const ReferenceOptions& options) {
    const auto& [bounces, samples, noise, filter, diffuse, visibleOnly, lambertOnly, lampShadows, seed, threads] =
        options;
    (void)threads;
    addAll(print, bounces, samples, noise, filter, diffuse, visibleOnly, lambertOnly, lampShadows, seed);
}

}  // namespace reflet
