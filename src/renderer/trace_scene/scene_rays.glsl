// Ray tracing by software traversal of the scene's BVH. Bindings 24 and 25 of set 0: SceneRays::bind.
// The includer defines testEveryHit and acceptHit (renderer/trace_scene/bvh.glsl), after scene_triangles.glsl, before this.
#ifndef REFLET_SCENE_RAYS_GLSL
#define REFLET_SCENE_RAYS_GLSL

#include "renderer/trace_scene/scene_triangles.glsl"

layout(scalar) readonly buffer SceneNodeBlock { BvhNode items[]; } sceneNodes;

BvhNode loadBvhNode(uint node) { return sceneNodes.items[node]; }

#include "renderer/trace_scene/bvh.glsl"

#endif
