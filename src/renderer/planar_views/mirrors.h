// Chooses the flat mirrors that get a planar reflection in a frame.
#pragma once

#include "effects/planar/planar.h"
#include "effects/view.h"
#include "scene/pose.h"

#include <span>
#include <string>
#include <vector>

namespace reflet {

/// The bounding rectangle, with sides along `right` and `up`, of a planar part of an instance.
struct FlatPiece {
    size_t instance = 0;     ///< index into Scene::instances
    std::string name;        ///< name of the instance
    vec4 plane{0, 1, 0, 0};  ///< unit normal toward the front; dot(plane, (p, 1)): metres in front of it
    vec3 right{1, 0, 0};     ///< unit, as seen from the front
    vec3 up{0, 0, -1};       ///< unit; as near to +Y as the plane allows
    vec2 low{0.0F};          ///< lower corner along right and up, from the world's origin [m]
    vec2 high{0.0F};
    float tolerance = 0.0F;  ///< largest distance of its vertices from the plane [m]
    float roughness = 0.0F;  ///< perceptual, mean over the material's texture
    vec3 f0{0.04F};          ///< reflectance at normal incidence, mean over the material's textures
    float area = 0.0F;       ///< area of its triangles [m²]
    bool doubleSided = false;
    bool bumpy = false;  ///< has a normal map
};

/// Planar parts of instances whose triangles lie in few planes, one per plane, at time 0. Other and deformed instances
/// have none.
std::vector<FlatPiece> findFlatPieces(const Scene& scene);

/// The pieces of the same scene at the given pose. pieces: from findFlatPieces; they are assumed to stay flat.
std::vector<FlatPiece> posedFlatPieces(std::span<const FlatPiece> pieces, const Scene& scene, const ScenePose& pose);

/// A plane to reflect the camera in, and its extent on screen.
struct Mirror {
    vec4 plane{0, 1, 0, 0};  ///< as in FlatPiece; the camera is in front of it
    vec3 right{1, 0, 0};
    vec3 up{0, 0, -1};
    vec2 low{0.0F};
    vec2 high{0.0F};
    float tolerance = 0.0F;
    vec2 uvLow{0.0F};  ///< extent on the screen, within 0..1
    vec2 uvHigh{0.0F};
    float area = 0.0F;  ///< share of the screen, ignoring occlusion
};

/// The same piece as seen from its other side.
FlatPiece turnedOver(FlatPiece piece);

/// The settings.count mirrors largest on screen, in descending order; coplanar pieces form one mirror. With names: only
/// instances of those names, whatever their roughness. Without: all smooth pieces. Mirrors that face away or are out of
/// view are left out.
std::vector<Mirror> planMirrors(std::span<const FlatPiece> pieces, const ViewParams& view,
                                std::span<const std::string> names, const PlanarSettings& settings);

/// Converts metres along right and up to a world-space point.
vec3 pointOn(const Mirror& mirror, const vec2& at);

}  // namespace reflet
