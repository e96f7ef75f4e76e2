// G-buffer of scenes whose materials all have the default reflectance.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/draw_gbuffer/gbuffer_draw.glsl"
