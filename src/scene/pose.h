// Evaluates a scene at a time: transforms of nodes, instances, joints, cameras and lights; weights of morph targets.
// Pure functions.
#pragma once

#include "scene/property.h"
#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace reflet {

/// Node-to-parent matrix.
glm::dmat4 localTransform(const Node& node);

/// From the coordinates of the scene's file to the world.
glm::dmat4 fileToWorld(const Scene& scene);

/// Seconds after which the scene repeats: the last key of its longest animation. 0: nothing is animated.
double animationDuration(const Scene& scene);

/// The time within the animations, in [0, duration). `time` is not negative.
double loopedTime(const Scene& scene, double time);

struct ScenePose {
    double time = 0.0;                        ///< from loopedTime
    std::vector<mat4> nodeToWorld;            ///< per node of Scene::nodes
    std::vector<bool> moving;                 ///< per node: it or an ancestor has channels, visibility included
    std::vector<mat4> objectToWorld;          ///< per instance; the identity for skinned instances
    std::vector<std::vector<mat4>> skins;     ///< per skin and joint: bind pose to world
    std::vector<std::vector<float>> weights;  ///< per instance and morph target; empty: it keeps its shape
    AnimatedProperties properties;
    std::vector<bool> hidden;  ///< per node; empty: none. Instances there are points: their matrix has rank 0
};

/// The material as the animations have it now.
const Material& materialAt(const Scene& scene, const ScenePose* pose, uint32_t material);

/// If several channels animate the same property of a node, the last one wins.
ScenePose scenePose(const Scene& scene, double time);

/// Whether the shape of the instance changes with time: it is skinned or morphed.
bool isDeformed(const Instance& instance);

/// Whether the instance is animated or deformed.
bool isAnimated(const ScenePose& pose, const Instance& instance);

/// Skinning matrix of a vertex that these joints move, from the mesh to the world. Normals are transformed by its
/// cofactor matrix.
mat4 skinToWorld(std::span<const JointWeight> vertex, const std::vector<mat4>& joints);

/// Whether the skin mirrors the mesh, which flips its winding (decided by the first joint).
bool flipsWinding(const std::vector<mat4>& joints);

/// The mesh's positions in world space, morphed and skinned.
std::vector<vec3> worldPositions(const Scene& scene, const ScenePose& pose, size_t instance);

/// Mesh-space box of the vertices that a joint influences.
struct JointBounds {
    uint32_t joint = 0;
    Aabb box;
};

/// Of the joints that influence any vertex: a skin may have very many more. joints: number of joints of the skin; 0: no
/// skin.
std::vector<JointBounds> jointBounds(const Mesh& mesh, size_t joints);

/// World-space bounds of the instance: its mesh's transformed box or, with a skin, the union of its joints' boxes,
/// which contains every weighted mean; with morph targets enlarged by their weighted boxes. byJoint: from jointBounds,
/// for instances with a skin.
Aabb instanceBounds(const Scene& scene, const ScenePose& pose, size_t instance,
                    const std::vector<JointBounds>& byJoint);

/// Moved with their node, if it is animated, and with animated lens or light; otherwise unchanged. What the view has
/// set otherwise than the scene is not animated. A lamp of a hidden node is dark.
Camera posed(Camera camera, const ScenePose& pose);
Lamp posed(Lamp lamp, const ScenePose& pose);
Sun posed(Sun sun, const ScenePose& pose);

/// Camera and sun at the view's time, which is replaced by loopedTime. Finds the distance of what a lens focuses on
/// (scene/focus.h), so focusDistance > 0 unless the camera is a pinhole.
View posed(View view, const Scene& scene);

/// The scene baked at that time, without animation: deformed instances get meshes of their own.
Scene frozen(const Scene& scene, double time);

}  // namespace reflet
