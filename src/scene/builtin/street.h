// Parts of the built-in scene "street". Metres; the street runs along z, the camera looks along -z; the road is at y =
// 0 between x = ±roadHalf, the pavements reach to the fronts of the houses at x = ±frontX.
#pragma once

#include "scene/builtin/canvas.h"
#include "scene/scene.h"

#include <span>
#include <string>
#include <vector>

namespace reflet::builtin::street {

constexpr float roadHalf = 3.6F;
constexpr float frontX = 6.2F;
constexpr float pavementY = 0.13F;
constexpr float nearEnd = 12.0F;  // z
constexpr float farEnd = -48.0F;  // z

/// Height of the road's surface, water included [m].
float roadHeight(const vec2& xz);

/// A side of the street as a transform: x to the right along the fronts, y up, z towards the street. The origin is at
/// the height of the road, at the given z. left: the side at smaller world x.
mat4 side(bool left, float z);

/// A round tube along a line; corners are mitred. u runs around, v along.
Mesh tube(std::span<const vec3> line, float radius, unsigned sides);

/// A cable that hangs between two points, `sag` lower in its middle.
Mesh cable(const vec3& from, const vec3& to, float sag, float radius);

/// A material that emits light [W/(m² sr)] and reflects little.
uint32_t addGlow(Scene& scene, const std::string& name, const vec3& radiance);

/// Appends a parallelogram from its lower left corner; uvs are metres, v downwards.
void addQuad(Mesh& mesh, const vec3& corner, const vec3& right, const vec3& up);

void addGround(Scene& scene);
void addHouses(Scene& scene);
void addSigns(Scene& scene);
void addLights(Scene& scene);
void addThings(Scene& scene);
void addCar(Scene& scene, const mat4& carToWorld);

/// Rows of houses use these: a module of a window or of a shop's front, whose origin is the middle of its lower edge.
class Openings {
public:
    explicit Openings(Scene& scene);
    static constexpr vec2 window{1.05F, 1.75F};  ///< size of the hole in the wall
    static constexpr float depth = 0.2F;         ///< of the glass behind the wall
    void addWindow(const mat4& toWorld, uint32_t number);
    /// A front from wall to wall, `height` high.
    void addShop(const mat4& toWorld, const vec2& size, uint32_t number);

private:
    Scene& scene_;
    uint32_t frame_ = 0;  ///< meshes
    uint32_t sill_ = 0;
    std::vector<uint32_t> panes_;
    std::vector<uint32_t> shopGlass_;  ///< materials
    std::vector<uint32_t> shopWood_;
    uint32_t awning_[3] = {};
};

}  // namespace reflet::builtin::street
