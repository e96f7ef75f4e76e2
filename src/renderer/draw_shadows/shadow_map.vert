// Sun shadow maps, opaque draws. The instance is the number of the cascade.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/shadow/shadow.h"

layout(scalar) uniform ParamsBlock { SunShadowParams params; };
layout(push_constant, scalar) uniform DrawBlock { mat4x3 objectToWorld; } draw;

layout(location = 0) in vec3 position;

void main() { gl_Position = params.maps[gl_InstanceIndex].worldToShadow * vec4(draw.objectToWorld * vec4(position, 1.0), 1.0); }
