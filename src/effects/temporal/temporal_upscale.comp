// Temporal upscaling of radiance alone.
#version 460
#extension GL_EXT_scalar_block_layout : require
#define HAS_COVERAGE 0
#include "effects/temporal/temporal_upscale.glsl"
