// Parts of the built-in scene "quay". Metres; the ground is at y = 0, the water at smaller x, the houses at larger.
#pragma once

#include "scene/scene.h"

namespace reflet::builtin {

/// A line along z.
struct Along {
    float x = 0.0F;
    float from = 0.0F;  ///< larger z
    float to = 0.0F;
};

/// A row of houses whose fronts are on the line, some windows lit.
void addHouses(Scene& scene, const Along& front);

/// Lamp posts and bollards along the edge, strings of bulbs over the quay, the swinging lantern of a crane, a beacon.
void addQuayLights(Scene& scene, const Along& edge);

/// Stalls with awnings of blended cloth and banners that swing, boats, cargo.
void addQuayThings(Scene& scene);

}  // namespace reflet::builtin
