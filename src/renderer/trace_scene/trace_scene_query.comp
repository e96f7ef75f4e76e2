// Ray tracing as a ray source, hardware ray query (trace_scene.glsl).
#version 460
#extension GL_EXT_ray_query : require
#extension GL_EXT_scalar_block_layout : require
#include "renderer/trace_scene/scene_surfaces.glsl"
#include "renderer/trace_scene/scene_rays_query.glsl"
#include "renderer/trace_scene/trace_scene.glsl"
