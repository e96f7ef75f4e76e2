// What a ray meets of a scene's triangles, whoever found it.
#ifndef REFLET_SCENE_HIT_GLSL
#define REFLET_SCENE_HIT_GLSL

#include "scene/bvh_layout.h"

struct SceneHit {
    float distance;     // in lengths of the ray's direction
    vec2 barycentrics;  // weights of the second and the third corner
    uint triangle;      // as loadSceneTriangle takes it
};

// Toward the front of the surface, not of unit length.
vec3 triangleNormal(SceneTriangle t) {
    vec3 n = cross(t.b - t.a, t.c - t.a);
    return (t.flags & triangleMirrored) != 0u ? -n : n;
}

// Whether a ray sees the back of a single-sided surface, through which the camera looks.
bool isHiddenBack(SceneTriangle t, vec3 direction) {
    return (t.flags & triangleDoubleSided) == 0u && dot(triangleNormal(t), direction) > 0.0;
}

#endif
