// G-buffer with a target for the reflectance.
#version 460
#extension GL_EXT_scalar_block_layout : require
#define REFLET_REFLECTANCE_TARGET
#include "renderer/draw_gbuffer/gbuffer_draw.glsl"
