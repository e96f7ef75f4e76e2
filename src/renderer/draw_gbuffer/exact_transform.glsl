// Transforms of positions that give the same bits in every shader and for every matrix of the same value: nothing is fused
// or reordered. Compilers need not honour `precise` for whole products of matrices, and one did not.
#ifndef REFLET_EXACT_TRANSFORM_GLSL
#define REFLET_EXACT_TRANSFORM_GLSL

vec3 exactTransform(mat4x3 m, vec3 p) {
    precise vec3 x = m[0] * p.x;
    precise vec3 y = m[1] * p.y;
    precise vec3 z = m[2] * p.z;
    precise vec3 xy = x + y;
    precise vec3 xyz = xy + z;
    precise vec3 sum = xyz + m[3];
    return sum;
}

vec4 exactTransform(mat4 m, vec3 p) {
    precise vec4 x = m[0] * p.x;
    precise vec4 y = m[1] * p.y;
    precise vec4 z = m[2] * p.z;
    precise vec4 xy = x + y;
    precise vec4 xyz = xy + z;
    precise vec4 sum = xyz + m[3];
    return sum;
}

#endif
