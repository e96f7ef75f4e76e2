// The import of one lamp's shadow map. The includer declares `hostMap`, and defines float metresAlong(vec3 direction):
// how far what the host's map shows is along a direction from the lamp, in lengths of it; 0: nothing is there.
#ifndef REFLET_IMPORT_LAMP_MAP_GLSL
#define REFLET_IMPORT_LAMP_MAP_GLSL

layout(local_size_x = 8, local_size_y = 8) in;
layout(r32f) uniform writeonly image2D atlas;

// Whose component along the tile's axis is 1.
vec3 directionOf(vec2 at, uint face) {
    if (notInlined(params.faces, gl_GlobalInvocationID.x) == 1u) {
        return params.tileZ.xyz + at.x * params.tileX.xyz + at.y * params.tileY.xyz;
    }
    uint axis = face / 2u;
    vec3 direction;
    direction[axis] = face % 2u == 0u ? 1.0 : -1.0;
    direction[(axis + 1u) % 3u] = at.x;
    direction[(axis + 2u) % 3u] = at.y;
    return direction;
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    uint face = gl_GlobalInvocationID.z;
    if (any(greaterThanEqual(texel, ivec2(params.side)))) {
        return;
    }
    vec2 at = ((2.0 * vec2(texel) + 1.0) / float(params.side) - 1.0) * params.halfTangent;
    float metres = metresAlong(directionOf(at, face));
    float stored = finite(metres) && metres > 0.0 ? min(params.near / metres, 1.0) : 0.0;
    uint tile = params.firstTile + face;
    ivec2 origin = ivec2(tile % params.columns, tile / params.columns) * int(params.cell);
    imageStore(atlas, origin + texel, vec4(stored));
}

#endif
