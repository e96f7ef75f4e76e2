// What rays hit: the scene's triangles in an Embree hierarchy, and the surface there.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace reflet {

struct Ray {
    vec3 origin{0.0F};
    vec3 direction{0.0F};  ///< of any length: distances count in it
    float near = 0.0F;
    float far = std::numeric_limits<float>::infinity();
};

enum class RayKind : uint8_t {
    camera,  ///< passes through the backs of single-sided surfaces, as the camera does
    light,   ///< everything is in its way
};

struct Hit {
    float distance = 0.0F;  ///< in lengths of the ray's direction
    uint32_t instance = 0;
    uint32_t triangle = 0;
    vec2 barycentric{0.0F};  ///< weights of the second and the third corner
};

/// A triangle in the world.
struct Triangle {
    vec3 a{0.0F};
    vec3 b{0.0F};
    vec3 c{0.0F};
};

class RayScene {
public:
    /// Keeps a reference to the scene. Throws Error where memory does not suffice.
    explicit RayScene(const Scene& scene);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;
    RayScene(RayScene&&) = delete;
    RayScene& operator=(RayScene&&) = delete;

    [[nodiscard]] std::optional<Hit> intersect(const Ray& ray, RayKind kind) const;
    [[nodiscard]] bool occluded(const Ray& ray, RayKind kind) const;

    [[nodiscard]] const Scene& scene() const;
    [[nodiscard]] Triangle triangle(uint32_t instance, uint32_t triangle) const;
    [[nodiscard]] const Material& material(uint32_t instance) const;
    /// Normal matrix, with the sign that keeps normals outside of mirrored instances.
    [[nodiscard]] const mat3& normalToWorld(uint32_t instance) const;
    [[nodiscard]] bool mirrored(uint32_t instance) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace reflet
