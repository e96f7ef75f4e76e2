// Which flat mirrors a frame draws views for.
#pragma once

#include "render/planar/planar.h"
#include "render/view.h"
#include "scene/pose.h"

#include <span>
#include <string>
#include <vector>

namespace reflet {

/// A rectangle in a plane, its sides along `right` and `up`, that holds a flat piece of an instance.
struct FlatPiece {
    size_t instance = 0;     ///< index into Scene::instances
    std::string name;        ///< of the instance
    vec4 plane{0, 1, 0, 0};  ///< unit normal toward the front; dot(plane, (p, 1)): metres in front of it
    vec3 right{1, 0, 0};     ///< unit, as seen from the front
    vec3 up{0, 0, -1};       ///< unit; as near to +Y as the plane allows
    vec2 low{0.0F};          ///< along right and up, from the world's origin [m]
    vec2 high{0.0F};
    float tolerance = 0.0F;  ///< its vertices are as near to the plane [m]
    float roughness = 0.0F;  ///< perceptual, mean over the material's texture
    bool doubleSided = false;
};

/// Instances whose triangles lie in few planes: one piece for each plane, at time 0. Others have none, and neither have
/// those with a skin.
std::vector<FlatPiece> findFlatPieces(const Scene& scene);

/// Where the pieces of the same scene are at the pose. pieces: of findFlatPieces; what is flat at time 0 is flat
/// always.
std::vector<FlatPiece> posedFlatPieces(std::span<const FlatPiece> pieces, const Scene& scene, const ScenePose& pose);

/// A plane to mirror the camera in, and what of it is on the screen.
struct Mirror {
    vec4 plane{0, 1, 0, 0};  ///< as of FlatPiece; the camera is in front of it
    vec3 right{1, 0, 0};
    vec3 up{0, 0, -1};
    vec2 low{0.0F};
    vec2 high{0.0F};
    float tolerance = 0.0F;
    vec2 uvLow{0.0F};  ///< on the screen, within 0..1
    vec2 uvHigh{0.0F};
    float area = 0.0F;  ///< share of the screen, if nothing hides it
};

/// The largest settings.count mirrors on the screen, largest first; pieces in one plane are one. With names: of the
/// instances that are called so, however rough; without: of smooth pieces. What the camera sees from behind, or not at
/// all, is none.
std::vector<Mirror> planMirrors(std::span<const FlatPiece> pieces, const ViewParams& view,
                                std::span<const std::string> names, const PlanarSettings& settings);

/// Metres along right and up to the world.
vec3 pointOn(const Mirror& mirror, const vec2& at);

}  // namespace reflet
