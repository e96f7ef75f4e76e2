// Tone mapping into RGBA16F.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(rgba16f) uniform writeonly image2D display;
#include "effects/tonemap/display.glsl"
