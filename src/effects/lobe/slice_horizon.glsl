// Ambient visibility of a slice's side by its horizon (Jimenez et al. 2016): what walkSide of slice.glsl finds, for white light, with
// everything covered below the highest direction to a surface.
// The includer, after slice.glsl, defines what loadSlice tells of a pixel apart: float loadSliceDepth(ivec2 pixel) and
// vec3 loadSliceNormal(ivec2 pixel).
#ifndef REFLET_SLICE_HORIZON_GLSL
#define REFLET_SLICE_HORIZON_GLSL

float cosineToEye(vec2 place) { return place.x > 0.0 ? place.y * inversesqrt(max(dot(place, place), 1e-18)) : 1.0; }

// No sample needs to know of another. The surface of the highest one goes on after it and began before it, on average by these
// shares of a step (in the logarithm): with half a step each, walls of known form factor are 4 % too dark, as the highest sample
// is often near the edge.
const float goesOnAfter = 0.375;
const float beganBefore = 0.25;

SliceSide walkHorizon(Slice s, float side, ivec2 pixel, float depth, vec3 n, SliceParams o, float shift, float dither) {
    float normal = side * s.normalAngle;
    float whole = arcShare(normal + quarterTurn, normal);
    Arc arc = Arc(vec2(sin(normal), cos(normal)), 0.5 / whole);
    vec2 origin = vec2(pixel) + 0.5;
    vec2 step = side * s.step;
    float last = min(pixelsToEdge(origin, step), o.radius * s.w.x / max(s.perPixel.x, 1e-20));
    float growth = exp2(log2(max(last / firstStep, 1.0)) / float(o.steps));
    float along = firstStep * pow(growth, shift);
    float fade = 1.0 / max(o.falloff * o.radius, 1e-6);
    vec2 perPixel = vec2(s.perPixel.x, side * s.perPixel.y);
    const float none = -2.0;
    float highest = none;  // cosine of the angle to the eye
    vec2 top = vec2(1.0, 0.0);
    float topPixels = 1.0;
    ivec2 topPixel = pixel;
    uint end = last < firstStep ? 0u : o.steps;
    for (uint i = 0u; i < end; ++i) {
        ivec2 at = clamp(ivec2(origin + along * step), ivec2(0), ivec2(own.size) - 1);
        along *= growth;
        float there = loadSliceDepth(at);
        vec2 away = vec2(at - pixel);
        float pixels = dot(away, step);
        float rise = there - (depth + dot(away, s.depthSlope));
        vec2 place = (pixels * perPixel + vec2(0.0, rise * s.perDepth)) / (s.w.x + side * pixels * s.w.y + rise * s.w.z);
        float r2 = dot(place, place);
        float cosine = cosineToEye(place);
        bool covers = there > 0.0 && pixels > 0.4 && (o.radius - sqrt(r2)) * fade > dither && cosine > highest;
        highest = covers ? cosine : highest;
        topPixel = covers ? at : topPixel;
        topPixels = covers ? pixels : topPixels;
        top = covers ? place : top;
    }
    vec3 normalThere = loadSliceNormal(topPixel);
    vec2 tangent = vec2(side * dot(normalThere, s.aside), max(dot(normalThere, s.toEye), leastFacing));
    vec2 after = onTangent(s, side, min(topPixels * pow(growth, goesOnAfter), max(last, topPixels)), top, tangent);
    vec2 before = onTangent(s, side, topPixels * pow(growth, -beganBefore), top, tangent);
    before = cosineToEye(after) > cosineToEye(before) ? after : before;
    top = cosineToEye(before) > highest ? before : top;
    uint above = highest > none ? uint(shareAbove(top, arc) * float(sectors) + dither) : sectors;
    SliceSide found;
    found.covered = ~sectorsBelow(above);
    found.behind = found.covered;
    found.share = whole / (arc.normal.y + normal * arc.normal.x);
    found.light = vec4(0.0);
    vec2 edge = vec2(arc.normal.y, -arc.normal.x);  // of the hemisphere
    vec2 middle = betweenPlaces(top, edge);
    vec3 toward = (side * middle.x * s.aside + middle.y * s.toEye) * inversesqrt(max(dot(middle, middle), 1e-18));
    found.turning = directionalFromRay(found.share * float(bitCount(found.covered)) / float(sectors), toward, n);
    return found;
}

#endif
