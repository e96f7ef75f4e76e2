// Shadow maps of lamps, opaque draws.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/shadow/lamp_shadow.h"

layout(scalar) uniform ParamsBlock { LampTileParams params; };
layout(push_constant, scalar) uniform DrawBlock { mat4x3 objectToWorld; uint tile; } draw;

layout(location = 0) in vec3 position;

void main() { gl_Position = params.worldToTile[draw.tile] * vec4(draw.objectToWorld * vec4(position, 1.0), 1.0); }
