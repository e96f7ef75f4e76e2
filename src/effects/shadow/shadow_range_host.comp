// Of a host's map, read in place.
#version 460
#extension GL_EXT_scalar_block_layout : require
#define HOST_SHADOW_MAP
#include "effects/shadow/shadow_range.glsl"
