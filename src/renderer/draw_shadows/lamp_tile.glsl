// Where a lamp's shadow map shows a vertex.
#ifndef REFLET_LAMP_TILE_GLSL
#define REFLET_LAMP_TILE_GLSL

#include "effects/shadow/lamp_shadow.h"

layout(scalar) uniform ParamsBlock { LampTileParams params; };
// tile: index of its matrix; plus reflectedInTile: as the lamp's mirror shows it.
layout(push_constant, scalar) uniform DrawBlock { mat4x3 objectToWorld; uint tile; uint lamp; } draw;

out gl_PerVertex {
    vec4 gl_Position;
    float gl_ClipDistance[1];
};

// Writes gl_Position; what is behind the lamp's mirror is clipped.
void placeInTile(vec3 position) {
    vec3 p = draw.objectToWorld * vec4(position, 1.0);
    vec4 mirror = params.mirror[draw.lamp];
    float inFront = dot(mirror, vec4(p, 1.0));
    p -= (draw.tile & reflectedInTile) != 0u ? 2.0 * inFront * mirror.xyz : vec3(0.0);
    gl_Position = params.worldToTile[draw.tile & ~reflectedInTile] * vec4(p, 1.0);
    gl_ClipDistance[0] = mirror.xyz == vec3(0.0) ? 1.0 : inFront;
}

#endif
