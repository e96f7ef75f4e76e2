// Rays through the hierarchy in the shader.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "scene_rays_test.h"
#include "renderer/trace_scene/scene_triangles.glsl"
const bool testEveryHit = false;
bool acceptHit(uint triangle, vec2 barycentrics, vec3 direction, bool first) { return barycentrics.x >= 0.5; }
#include "renderer/trace_scene/scene_rays.glsl"
#include "scene_rays_test.glsl"
