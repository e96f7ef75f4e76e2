// Direct light with ray-traced shadows, software BVH traversal (direct_rays.glsl).
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/trace_scene/scene_surfaces.glsl"
#include "renderer/trace_scene/scene_rays.glsl"
#include "renderer/trace_scene/direct_rays.glsl"
