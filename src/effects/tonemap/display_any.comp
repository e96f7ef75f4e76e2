// Tone mapping into any format (shaderStorageImageWriteWithoutFormat).
#version 460
#extension GL_EXT_scalar_block_layout : require

uniform writeonly image2D display;
#include "effects/tonemap/display.glsl"
