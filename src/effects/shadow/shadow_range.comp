// Of maps that the renderer draws.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/shadow/shadow_range.glsl"
