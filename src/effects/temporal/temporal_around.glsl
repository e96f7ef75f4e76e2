// The 3x3 neighbourhoods of a frame that is smaller than the output: mean and variance, and the motion of the nearest
// surface; and how the mean changed over frames at rest. In: this frame's radiance, depth, motion; what changed so far.
// Out: around, spread, changes.
#include "effects/temporal/temporal.h"
#include "shaders/not_inlined.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { TemporalParams params; };
layout(rgba16f) uniform readonly image2D radiance;
uniform sampler2D depth;
uniform sampler2D motion;
layout(rgba16f) uniform writeonly image2D around;  // mean, tone-compressed; motion in x
layout(rgba16f) uniform writeonly image2D spread;  // standard deviation; motion in y
layout(rgba16f) uniform readonly image2D previousChanges;
layout(rgba16f) uniform writeonly image2D changes;  // of the mean's luma, over frames: mean, variance, recent difference
#if HAS_COVERAGE
uniform sampler2D coverage;
layout(rg16f) uniform writeonly image2D coveredAround;  // mean, standard deviation
#endif
#include "effects/temporal/temporal_rows.glsl"

const float stillest = 0.25;      // of the frame's pixels; faster motion counts as not at rest
const float lastingFrames = 16.0;
const float recentShare = 0.25;   // weight of a frame in the recent difference

// Jitter changes the mean, too: only the differences of several frames together tell that light changed.
void keepChanges(ivec2 pixel, float luma, vec2 moved) {
    vec4 past = vec4(0.0);
    if (notInlined(params.hasPrevious, gl_GlobalInvocationID.x) != 0u && length(moved * vec2(params.size)) < stillest) {
        past = imageLoad(previousChanges, pixel);
    }
    float frames = min(past.a + 1.0, lastingFrames);
    float off = past.a > 0.0 ? luma - past.x : 0.0;
    imageStore(changes, pixel, roundToHalf(vec4(past.x + (luma - past.x) / frames, mix(past.y, off * off, 1.0 / frames),
                                                mix(past.z, off, recentShare), frames)));
}

void resolve(ivec2 pixel, Row above, Row row, Row below) {
    float nearest = max(max(above.nearest, below.nearest), row.nearest);
    vec2 moved = motionAt(nearest > 0.0 ? nearestAround(above, row, below) : pixel, nearest);
    vec3 middle = (above.sum + row.sum + below.sum) / 9.0;
    vec3 variance = max((above.squares + row.squares + below.squares) / 9.0 - middle * middle, 0.0);
    keepChanges(pixel, middle.x, moved);
    imageStore(around, pixel, roundToHalf(vec4(middle, moved.x)));
    imageStore(spread, pixel, roundToHalf(vec4(sqrt(variance), moved.y)));
#if HAS_COVERAGE
    float covered = (above.coveredSum + row.coveredSum + below.coveredSum) / 9.0;
    float squares = (above.coveredSquares + row.coveredSquares + below.coveredSquares) / 9.0;
    imageStore(coveredAround, pixel, roundToHalf(vec4(covered, sqrt(max(squares - covered * covered, 0.0)), 0.0, 0.0)));
#endif
}

#include "effects/temporal/temporal_columns.glsl"
