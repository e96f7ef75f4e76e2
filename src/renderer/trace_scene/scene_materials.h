// Materials and instances of the scene, for ray hits. Shared by C++ and GLSL.
#ifndef REFLET_RENDERER_SCENE_MATERIALS_H
#define REFLET_RENDERER_SCENE_MATERIALS_H

#include "base/shared.h"
#include "renderer/material.h"

SHARED_BEGIN

const uint wrapRepeat = 0;
const uint wrapMirror = 1;
const uint wrapClamp = 2;

// A texture slot of a material.
struct SceneTexture {
    uint layer;
    uint wrapU;
    uint wrapV;
    uint nearest;      // 1: nearest filtering under magnification
    uint mips;         // 0: only the finest level is used
    float firstLevel;  // level of the layer at which the image has its own resolution
    vec2 size;         // of the image, in texels
};

struct SceneMaterial {
    MaterialParams params;
    SceneTexture textures[sceneSlotCount];
};

// An instance of a mesh: its first vertex, and the columns of its 3x3 object-to-world matrix.
struct SceneInstance {
    vec3 axisX;
    uint material;
    vec3 axisY;
    uint firstVertex;
    vec3 axisZ;
    uint unused;
};

// Values of the specialization constant `throughGlass` (scene_surfaces.glsl): how paths pass glass.
const uint glassStraight = 0;  // stochastically, without refraction
const uint glassRefracts = 1;  // refracted as in the reference
const uint glassOfView = 2;    // the same; rays are view rays that start in front of glass whose own light is known

SHARED_END

#endif
