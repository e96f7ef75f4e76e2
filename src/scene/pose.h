// Where everything of a scene is at a time. Pure: the same for the same scene and time.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace reflet {

/// From the node to its parent.
glm::dmat4 localTransform(const Node& node);

/// Seconds after which the scene begins again: the last key of its longest animation. 0: nothing ever moves.
double animationDuration(const Scene& scene);

/// The time in the animations, 0 to less than their duration. time: not negative.
double loopedTime(const Scene& scene, double time);

struct ScenePose {
    double time = 0.0;                     ///< as of loopedTime
    std::vector<mat4> nodeToWorld;         ///< of Scene::nodes
    std::vector<bool> moving;              ///< by node: it or what it hangs from has channels
    std::vector<mat4> objectToWorld;       ///< of Scene::instances; of those with a skin: the identity
    std::vector<std::vector<mat4>> skins;  ///< by skin and joint: from the bound mesh to the world
};

/// Where several channels move the same property of a node the last one does.
ScenePose scenePose(const Scene& scene, double time);

/// Whether the instance is not where it was loaded at every time, or has a skin.
bool moves(const ScenePose& pose, const Instance& instance);

/// A skinned vertex: from the mesh to the world. Positions as they are, normals by its cofactors.
mat4 skinToWorld(const VertexSkin& vertex, const std::vector<mat4>& joints);

/// Whether the skin turns the mesh inside out (its first joint mirrors).
bool turnsOver(const std::vector<mat4>& joints);

/// The mesh's positions in the world, skinned where the instance has a skin.
std::vector<vec3> worldPositions(const Scene& scene, const ScenePose& pose, size_t instance);

/// By joint: the box around the vertices that it moves, in the mesh. Empty where it moves none. joints: of the skin;
/// 0: none.
std::vector<Aabb> jointBounds(const Mesh& mesh, size_t joints);

/// Holds everything of the instance: exact without a skin; with one a box around its joints' boxes, which holds every
/// mean of what they move. byJoint: of jointBounds, for instances with a skin.
Aabb instanceBounds(const Scene& scene, const ScenePose& pose, size_t instance, const std::vector<Aabb>& byJoint);

/// What hangs from a node that moves, where it is then. Others stay as they are.
Camera posed(Camera camera, const ScenePose& pose);
Lamp posed(Lamp lamp, const ScenePose& pose);
Sun posed(Sun sun, const ScenePose& pose);

/// Camera and sun where they are at the view's time, which becomes that of loopedTime.
View posed(View view, const Scene& scene);

/// A scene that stands still as this one is at that time: skinned instances have meshes of their own.
Scene frozen(const Scene& scene, double time);

}  // namespace reflet
