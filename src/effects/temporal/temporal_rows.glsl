// 3x3 neighbourhoods of this frame's pixels, a row at a time, so that pixels above one another share their loads.
// The includer declares params.size, the images radiance, depth and motion, and with HAS_COVERAGE coverage.
#ifndef REFLET_TEMPORAL_ROWS_GLSL
#define REFLET_TEMPORAL_ROWS_GLSL

#include "shaders/half_float.glsl"
#include "shaders/projection.glsl"
#include "shaders/tone_compressed.glsl"

// Three pixels side by side.
struct Row {
    vec3 middle;   // linear
    vec3 sum;      // tone-compressed
    vec3 squares;
    float nearest;  // reversed depth
    ivec2 at;       // of that
#if HAS_COVERAGE
    float covered;         // the middle pixel
    float coveredSum;
    float coveredSquares;
#endif
};

Row loadRow(ivec2 pixel) {
    ivec2 last = ivec2(params.size) - 1;
    Row row;
    row.sum = vec3(0.0);
    row.squares = vec3(0.0);
    row.nearest = -1.0;
#if HAS_COVERAGE
    row.covered = texelFetch(coverage, clamp(pixel, ivec2(0), last), 0).r;
    row.coveredSum = 0.0;
    row.coveredSquares = 0.0;
#endif
    for (int x = -1; x <= 1; ++x) {
        ivec2 at = clamp(pixel + ivec2(x, 0), ivec2(0), last);
        vec3 c = clampToHalf(imageLoad(radiance, at).rgb);
        row.middle = x == 0 ? c : row.middle;
        vec3 t = toneCompress(c);
        row.sum += t;
        row.squares += t * t;
        float d = texelFetch(depth, at, 0).r;
        row.at = d > row.nearest ? at : row.at;
        row.nearest = max(d, row.nearest);
#if HAS_COVERAGE
        float covered = texelFetch(coverage, at, 0).r;
        row.coveredSum += covered;
        row.coveredSquares += covered * covered;
#endif
    }
    return row;
}

// The pixel with the nearest surface in the 3x3 neighbourhood.
ivec2 nearestAround(Row above, Row row, Row below) {
    ivec2 at = above.nearest > row.nearest ? above.at : row.at;
    return below.nearest > max(above.nearest, row.nearest) ? below.at : at;
}

// uv now minus uv in the last frame. The G-buffer has no motion for the sky, which must still follow the camera's
// rotation to avoid ghosting.
vec2 motionAt(ivec2 pixel, float nearest) {
    if (nearest > 0.0) {
        return texelFetch(motion, pixel, 0).rg;
    }
    vec2 uv = pixelToUv(pixel, 1.0 / vec2(params.size));
    vec4 before = params.skyToPrevious * vec4(uvToNdc(uv), 0.0, 1.0);
    return before.w > 0.0 ? uv - ndcToUv(before.xy / before.w) : vec2(2.0);  // 2: off-screen: it was behind the camera
}

#endif
