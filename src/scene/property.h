// Properties of materials, lamps, cameras and nodes that animations change (KHR_animation_pointer): numbers, colours,
// and whether a node is visible. After: Khronos, glTF 2.0 Asset Object Model Specification, 2023.
#pragma once

#include "scene/scene.h"

#include <functional>
#include <map>
#include <vector>

namespace reflet {

/// Of the camera or lamp at a node: as the scene has it, and now. Only the lens is meant, and light, range and cone.
struct AnimatedLens {
    Camera resting;
    Camera now;
};
struct AnimatedLight {
    Lamp resting;
    Lamp now;
};

/// What animations make of a scene's materials, lenses and lights.
struct AnimatedProperties {
    std::map<uint32_t, Material> materials;  ///< by index into Scene::materials
    std::map<int32_t, AnimatedLens> lenses;  ///< by node
    std::map<int32_t, AnimatedLight> lights;
    std::map<int32_t, bool> visible;  ///< by node
};

/// valueOf: what a channel has at the time in question. Values that the property does not allow, such as those of
/// splines beyond their keys, are the nearest that it does.
AnimatedProperties animatedProperties(const Scene& scene, const std::function<vec4(const PropertyChannel&)>& valueOf);

/// Gives materials, lamps and sun the largest values that they have at any time, so that what depends on whether a
/// property is used at all sees that it is, and cameras the lens of time 0. Reflectances become those that differ most
/// from the default.
void applyLargestProperties(Scene& scene);

[[nodiscard]] bool hasAnimatedMaterials(const Scene& scene);

/// Per material: whether an animation changes the property.
std::vector<bool> materialsWithAnimated(const Scene& scene, Property property);

/// Per node: whether it or a node above it is visible at some times alone; empty: none.
std::vector<bool> nodesThatAppear(const Scene& scene);

}  // namespace reflet
