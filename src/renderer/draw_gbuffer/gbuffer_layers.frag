// G-buffer with targets for the reflectance, and for sheen and anisotropy.
#version 460
#extension GL_EXT_scalar_block_layout : require
#define REFLET_REFLECTANCE_TARGET
#define REFLET_LAYERS_TARGET
#include "renderer/draw_gbuffer/gbuffer_draw.glsl"
