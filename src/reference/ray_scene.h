// Ray queries against the scene's triangles, in an Embree BVH.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace reflet {

struct Ray {
    vec3 origin{0.0F};
    vec3 direction{0.0F};  ///< any length; it is the unit of distances
    float near = 0.0F;
    float far = std::numeric_limits<float>::infinity();
    /// Decides, with a hash of the triangle, which blended surfaces the ray passes through (stochastic transparency).
    /// 0: it passes through all that are not opaque.
    uint32_t random = 0;
};

enum class RayKind : uint8_t {
    camera,  ///< ignores the back faces of single-sided surfaces
    inside,  ///< for a camera inside a volume of glass: as `camera`, but hits the back faces of such volumes
    light,   ///< hits both sides of all surfaces
};

struct Hit {
    float distance = 0.0F;  ///< in lengths of the ray's direction
    uint32_t instance = 0;
    uint32_t triangle = 0;
    vec2 barycentric{0.0F};  ///< weights of the second and the third vertex
};

/// A triangle in world space.
struct Triangle {
    vec3 a{0.0F};
    vec3 b{0.0F};
    vec3 c{0.0F};
};

class RayScene {
public:
    /// Keeps a reference to the scene. Throws Error if there is not enough memory.
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
    /// Normal matrix, with its sign chosen so that normals of mirrored instances point outwards.
    [[nodiscard]] const mat3& normalToWorld(uint32_t instance) const;
    [[nodiscard]] bool mirrored(uint32_t instance) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace reflet
