// How a bounding volume hierarchy lies in memory. Shared by C++ and GLSL.
#ifndef REFLET_SCENE_BVH_LAYOUT_H
#define REFLET_SCENE_BVH_LAYOUT_H

#include "base/shared.h"

SHARED_BEGIN

// A node is an inner node: the boxes of its two children, and where they are. Nodes are 64 bytes, triangles 48: a ray
// moves 64 bytes for each pair of boxes that it is tested against, and 48 for each triangle. A ray across all of the
// scene "cave" (35,000 triangles) meets 42 nodes and 7 triangles, as the surface area heuristic has it: 3 KB.
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

// A child is the index of a node, or (bvhLeaf set) of the first of 1 to 8 triangles: bits 28..30 hold their number
// less 1.
const uint bvhLeaf = 0x80000000u;
const uint bvhCountShift = 28;
const uint bvhMaxLeaf = 8;
const uint bvhFirstMask = 0x0FFFFFFFu;

// No way from the root to a leaf has more nodes: what a traversal's stack must hold.
const uint bvhMaxDepth = 32;

// A triangle in the world. Its corners in the order of the mesh: seen from the front they are counter-clockwise, but
// clockwise where a mirrored instance turns them over (triangleMirrored).
struct SceneTriangle {
    vec3 a;
    uint instance;  // index into Scene::instances
    vec3 b;
    uint firstIndex;  // of its three indices in the list of all meshes' indices, mesh after mesh
    vec3 c;
    uint flags;  // triangle…
};

const uint triangleCutOut = 1;       // the material has an alpha cutoff
const uint triangleDoubleSided = 2;  // the material is double-sided
const uint triangleMirrored = 4;     // the instance mirrors: its front is where the corners are clockwise

SHARED_END

#endif
