// Tone mapping into A2B10G10R10.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(rgb10_a2) uniform writeonly image2D display;
#include "effects/tonemap/display.glsl"
