// The 3x3 neighbourhoods of a frame that is smaller than the output: mean and variance, and the motion of the nearest
// surface; what is seen, and how the mean has changed. In: this frame's radiance, depth, motion; what was seen, and what
// changed so far. Out: around, spread, seen, changes, changed.
#include "effects/temporal/temporal.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { TemporalParams params; };
layout(rgba16f) uniform readonly image2D radiance;
uniform sampler2D depth;
uniform sampler2D motion;
layout(rgba16f) uniform writeonly image2D around;  // mean, tone-compressed; motion in x
layout(rgba16f) uniform writeonly image2D spread;  // standard deviation; motion in y
layout(rgba16f) uniform readonly image2D previousSeen;
layout(rgba16f) uniform writeonly image2D seen;  // distance, own motion, 1: at rest
layout(r8) uniform readonly image2D previousLeft;
layout(r8) uniform writeonly image2D left;  // 1: something that was at rest here moves from here on
layout(rgba16f) uniform readonly image2D previousChanges;
layout(rgba16f) uniform writeonly image2D changes;
layout(rgba16f) uniform writeonly image2D changed;  // disturbed, relit (-1: the last frame showed another surface), reactive, left
#if HAS_COVERAGE
uniform sampler2D coverage;
layout(rg16f) uniform writeonly image2D coveredAround;  // mean, standard deviation
#endif
#include "effects/temporal/temporal_changes.glsl"

void resolve(ivec2 pixel, Row above, Row row, Row below) {
    Seen now = seenAt(pixel, above, row, below);
    vec3 middle = (above.sum + row.sum + below.sum) / 9.0;
    vec3 variance = max((above.squares + row.squares + below.squares) / 9.0 - middle * middle, 0.0);
    Changed change = changedAt(pixel, steadyLight(above, row, below), now);
    float relit = now.follows ? change.relit : -1.0;
    imageStore(changed, pixel, roundToHalf(vec4(change.disturbed, relit, reactiveAt(pixel), now.left ? 1.0 : 0.0)));
    imageStore(around, pixel, roundToHalf(vec4(middle, now.moved.x)));
    imageStore(spread, pixel, roundToHalf(vec4(sqrt(variance), now.moved.y)));
#if HAS_COVERAGE
    float covered = (above.coveredSum + row.coveredSum + below.coveredSum) / 9.0;
    float squares = (above.coveredSquares + row.coveredSquares + below.coveredSquares) / 9.0;
    imageStore(coveredAround, pixel, roundToHalf(vec4(covered, sqrt(max(squares - covered * covered, 0.0)), 0.0, 0.0)));
#endif
}

#include "effects/temporal/temporal_columns.glsl"
