// Casts rays on the CPU, to look at a scene before it is rendered: a hierarchy for each mesh, which its instances
// share. For a few thousand rays; rendering has its own (bvh.h, reference/ray_scene.h).
#pragma once

#include "scene/bvh.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace reflet {

class RayCaster {
public:
    struct Hit {
        float distance = std::numeric_limits<float>::infinity();  ///< in units of the direction's length
        uint32_t instance = 0;
        bool back = false;  ///< met from behind
        vec3 normal{0.0F};  ///< of the triangle in the world, unit, on the side that was met

        explicit operator bool() const { return distance < std::numeric_limits<float>::infinity(); }
    };

    enum class Faces : uint8_t {
        all,
        drawn,     ///< without back faces of single-sided materials
        blocking,  ///< without materials that light may pass: transmissive and blended ones
    };

    /// Of instances as they are at time 0: scene.nodes must be empty. The scene must outlive this object.
    explicit RayCaster(const Scene& scene);

    /// The nearest hit in front of the origin.
    [[nodiscard]] Hit cast(const vec3& from, const vec3& direction, Faces faces = Faces::all) const;
    /// Of one instance.
    [[nodiscard]] Hit castAt(uint32_t instance, const vec3& from, const vec3& direction) const;

    /// World-space bounds of an instance.
    [[nodiscard]] const Aabb& bounds(uint32_t instance) const { return placed_[instance].bounds; }

private:
    struct Placed {
        Aabb bounds;
        mat4 toObject{1.0F};
        bool mirrored = false;
        bool doubleSided = false;
        bool blocks = true;
    };

    void castInto(uint32_t instance, const vec3& from, const vec3& direction, Faces faces, Hit& nearest) const;

    const Scene& scene_;
    std::vector<std::optional<Bvh>> meshes_;  ///< those that instances show, in object space
    std::vector<Placed> placed_;
};

}  // namespace reflet
