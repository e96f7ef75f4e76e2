// A ray's hit on the triangles of the scene, found by the BVH traversal or by ray query.
#ifndef REFLET_SCENE_HIT_GLSL
#define REFLET_SCENE_HIT_GLSL

#include "scene/bvh_layout.h"

struct SceneHit {
    float distance;     // in lengths of the ray's direction
    vec2 barycentrics;  // weights of the second and third vertex
    uint triangle;      // index for loadSceneTriangle
};

// Geometric normal toward the front side, not normalized.
vec3 triangleNormal(SceneTriangle t) {
    vec3 n = cross(t.b - t.a, t.c - t.a);
    return (t.flags & triangleMirrored) != 0u ? -n : n;
}

#endif
