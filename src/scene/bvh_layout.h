// Memory layout of a bounding volume hierarchy. Shared by C++ and GLSL.
#ifndef REFLET_SCENE_BVH_LAYOUT_H
#define REFLET_SCENE_BVH_LAYOUT_H

#include "base/shared.h"

SHARED_BEGIN

// Every node is an inner node: the boxes of its two children, and their indices. A ray reads 64 bytes for each pair of
// boxes that it is tested against, and 48 for each triangle. By the SAH's estimate a ray across all of the scene "cave"
// (35,000 triangles) visits 42 nodes and 7 triangles: 3 KB.
struct BvhNode {
    vec3 leftMin;
    uint left;  // child, as below
    vec3 leftMax;
    uint right;
    vec3 rightMin;
    uint unused0;
    vec3 rightMax;
    uint unused1;
};

// A child is the index of a node or, with bvhLeaf set, of the first of 1 to 8 triangles; bits 28..30 hold their number
// minus 1.
const uint bvhLeaf = 0x80000000u;
const uint bvhCountShift = 28;
const uint bvhMaxLeaf = 8;
const uint bvhFirstMask = 0x0FFFFFFFu;

// Maximum number of nodes from the root to a leaf: the stack size of a traversal.
const uint bvhMaxDepth = 32;

// A triangle in world space. Vertices in the order of the mesh: counter-clockwise as seen from the front, but clockwise
// in mirrored instances (triangleMirrored).
struct SceneTriangle {
    vec3 a;
    uint instance;  // index into Scene::instances
    vec3 b;
    uint firstIndex;  // of its three indices, in the concatenated index lists of all meshes
    vec3 c;
    uint flags;  // the triangle... bits below
};

const uint triangleCutOut = 1;       // rays may pass: the material has an alpha cutoff or is transmissive
const uint triangleDoubleSided = 2;  // the material is double-sided
const uint triangleMirrored = 4;     // the instance mirrors: front faces are clockwise

SHARED_END

#endif
