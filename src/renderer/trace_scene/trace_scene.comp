// Ray tracing as a ray source, software BVH traversal (trace_scene.glsl).
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/trace_scene/scene_surfaces.glsl"
#include "renderer/trace_scene/scene_rays.glsl"
#include "renderer/trace_scene/trace_scene.glsl"
