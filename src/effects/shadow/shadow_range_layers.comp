// Of a host's maps, a layer per cascade, read in place.
#version 460
#extension GL_EXT_scalar_block_layout : require
#define HOST_SHADOW_MAP
#define HOST_SHADOW_ARRAY
#include "effects/shadow/shadow_range.glsl"
