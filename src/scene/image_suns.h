// Suns in environment images: few texels that bring a large share of the light. Rays that miss the scene find them by
// chance, as fireflies; as directional lights they have shadow maps, and highlights without noise.
#pragma once

#include "scene/scene.h"

#include <memory>
#include <vector>

namespace reflet {

/// A compact cluster of texels, for an environment of intensity 1 and rotation 0.
struct ImageSun {
    vec3 toSun{0, 1, 0};    ///< unit
    vec3 irradiance{0.0F};  ///< of what the cluster has above its surroundings, on a surface that faces it [W/m²]
    float angularDiameter = 0.0F;  ///< of a uniform disk with the cluster's spread [rad]
};

struct ImageSuns {
    std::vector<ImageSun> suns;               ///< the strongest first
    std::shared_ptr<const FloatImage> image;  ///< the clusters replaced by their surroundings; null: there are none
};

/// Clusters are at most 4 degrees in radius, of texels with more than 12 times the mean radiance of the rest of the
/// image, and bring at least 1/64 of its light. Larger bright areas, such as windows and soft boxes, are none: rays
/// find them. image: "R" "G" "B".
ImageSuns findImageSuns(const FloatImage& image);

/// The view as a renderer with one sun lights it: the image without its suns, the strongest light as the sun; `others`
/// gets what remains, as directional lamps. The sum of all light is the view's.
View withImageSuns(View view, const ImageSuns& found, std::vector<Lamp>& others);

}  // namespace reflet
