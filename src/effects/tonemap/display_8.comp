// Tone mapping into RGBA8.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(rgba8) uniform writeonly image2D display;
#include "effects/tonemap/display.glsl"
