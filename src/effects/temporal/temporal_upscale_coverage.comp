// Temporal upscaling of radiance and coverage.
#version 460
#extension GL_EXT_scalar_block_layout : require
#define HAS_COVERAGE 1
#include "effects/temporal/temporal_upscale.glsl"
