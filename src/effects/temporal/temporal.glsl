// Temporal antialiasing. In: this frame's radiance, depth, motion; history: mean, length, deviations. Out: the history
// with this frame. With HAS_COVERAGE also the coverage of pixels by surfaces, averaged with the radiance that is
// premultiplied by it: with the same weights, so that their quotient is the surfaces' colour.
#include "effects/temporal/temporal.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock {
    TemporalParams params;
};
layout(rgba16f) uniform readonly image2D radiance;
uniform sampler2D depth;
uniform sampler2D motion;
layout(rgba16f) uniform readonly image2D previousMean;  // radiance, history length
layout(rg16f) uniform readonly image2D previousDeviations;
layout(rgba16f) uniform readonly image2D previousSeen;
layout(rgba16f) uniform writeonly image2D seen;  // distance, own motion, 1: at rest
layout(r8) uniform readonly image2D previousLeft;
layout(r8) uniform writeonly image2D left;  // 1: something that was at rest here moves from here on
layout(rgba16f) uniform readonly image2D previousChanges;
layout(rgba16f) uniform writeonly image2D changes;
layout(rgba16f) uniform writeonly image2D mean;
layout(rg16f) uniform writeonly image2D deviations;
#if HAS_COVERAGE
uniform sampler2D coverage;
layout(r32f) uniform readonly image2D previousCoverage;
layout(r32f) uniform writeonly image2D meanCoverage;
#endif
const vec2 allowance = vec2(1.0, 1.25);
const vec2 pixelStaleLimits = vec2(0.25, 0.5);
// Share of the mean of 3x3 pixels in what is shown without a history. FLIP of the first frame with 0, 0.3, 0.5, hybrid,
// 320x180: builtin:colonnade 0.103, 0.091, 0.090; mirror-hall 0.172, 0.146, 0.150; moving 0.121, 0.107, 0.110.
const float aloneBlur = 0.3;
#include "effects/temporal/temporal_changes.glsl"
#include "effects/temporal/temporal_history.glsl"

void resolve(ivec2 pixel, Row above, Row row, Row below) {
    Seen surface = seenAt(pixel, above, row, below);
    Shown now;
    now.own = row.middle;
    now.inside = 1.0;
    now.blurred = row.middle;
    now.near = 1.0;
    now.middle = (above.sum + row.sum + below.sum) / 9.0;
    now.variance = max((above.squares + row.squares + below.squares) / 9.0 - now.middle * now.middle, 0.0);
    now.moved = surface.moved * vec2(params.size);
    now.follows = surface.follows;
    now.left = surface.left ? 1.0 : 0.0;
    Changed change = changedAt(pixel, steadyLight(above, row, below), surface);
    now.disturbed = change.disturbed;
    now.relit = change.relit;
    now.reactive = reactiveAt(pixel);
#if HAS_COVERAGE
    now.covered = row.covered;
    now.coveredMiddle = (above.coveredSum + row.coveredSum + below.coveredSum) / 9.0;
    float squares = (above.coveredSquares + row.coveredSquares + below.coveredSquares) / 9.0;
    now.coveredVariance = max(squares - now.coveredMiddle * now.coveredMiddle, 0.0);
#endif
    accumulate(pixel, now);
}

#include "effects/temporal/temporal_columns.glsl"
