// Shadow maps of lamps, opaque draws.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/draw_shadows/lamp_tile.glsl"

layout(location = 0) in vec3 position;

void main() { placeInTile(position); }
