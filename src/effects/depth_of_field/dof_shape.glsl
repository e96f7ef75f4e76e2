// The aperture's shape.
#ifndef REFLET_DOF_SHAPE_GLSL
#define REFLET_DOF_SHAPE_GLSL

layout(constant_id = 0) const uint polygon = 0u;  // shape of the aperture; 0: round

// Length of a way as a share of what the aperture's shape has in that direction. turn: of the aperture [rad]
float shapeLength(vec2 way, float turn, uint blades) {
    if (polygon == 0u) {
        return length(way);
    }
    float side = 6.28318531 / float(blades);
    float within = atan(-way.y, way.x) - turn;
    within -= side * (floor(within / side) + 0.5);
    return length(way) * cos(within) / cos(0.5 * side);
}

// Of four ways.
vec4 shapeLengths(vec4 x, vec4 y, float turn, uint blades) {
    return vec4(shapeLength(vec2(x.x, y.x), turn, blades), shapeLength(vec2(x.y, y.y), turn, blades),
                shapeLength(vec2(x.z, y.z), turn, blades), shapeLength(vec2(x.w, y.w), turn, blades));
}

#endif
