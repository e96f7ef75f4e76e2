// How rays find what the scene's triangles are made of. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_SCENE_MATERIALS_H
#define REFLET_RENDER_SCENE_MATERIALS_H

#include "base/shared.h"
#include "render/material.h"

SHARED_BEGIN

const uint wrapRepeat = 0;
const uint wrapMirror = 1;
const uint wrapClamp = 2;

// An image as a slot of a material reads it.
struct SceneTexture {
    uint layer;
    uint wrapU;
    uint wrapV;
    uint nearest;      // 1: texels are not interpolated where they are seen larger than they are
    uint mips;         // 0: it is read at its own size only
    float firstLevel;  // of the layer, that the image fills
    vec2 size;         // of the image, in texels
};

struct SceneMaterial {
    MaterialParams params;
    SceneTexture textures[slotCount];
};

// A mesh at a place: where its vertices begin, and the columns that turn its directions to the world.
struct SceneInstance {
    vec3 axisX;
    uint material;
    vec3 axisY;
    uint firstVertex;
    vec3 axisZ;
    uint unused;
};

SHARED_END

#endif
