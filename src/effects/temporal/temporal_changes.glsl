// How the 3x3 neighbourhoods of a surface's pixels change from frame to frame. The includer declares params as
// TemporalParams and the images previousChanges and changes: of steadyLuma over the frames that showed the surface: mean,
// variance, recent mean difference, and their number.
#ifndef REFLET_TEMPORAL_CHANGES_GLSL
#define REFLET_TEMPORAL_CHANGES_GLSL

#include "effects/temporal/temporal_rows.glsl"
#include "effects/temporal/temporal_stale.glsl"

const float lastingFrames = 16.0;
const vec2 staleLimits = vec2(0.4, 0.8);
const float asGoodAsStill = 1.0 / 64.0;  // pixels
const float mostRelit = 16.0;
// Of fewer frames nobody knows how much jitter changes the mean: all that follow a first one far off differ from it alike.
const float fewestFrames = 4.0;

struct Changed {
    float stale;  // 0 to 1; -1: it is the sky, whose motion is known exactly, and which does not change
    float relit;  // factor on what is kept of earlier frames
};

// Jitter changes the mean, too: only the differences of several frames together tell that light changed. Then earlier
// frames count as lit alike, so that the detail they have is kept.
// Neighbourhoods of frames of another size are others: what is known of them starts anew.
Changed changedAt(ivec2 pixel, float luma, Seen now) {
    if (now.sky) {
        imageStore(changes, pixel, vec4(0.0));
        return Changed(-1.0, 1.0);
    }
    vec4 past = vec4(0.0);
    // Of what moves, even slowly, neighbourhoods are never the same.
    bool rests = length(now.moved * vec2(params.size)) < asGoodAsStill;
    if (now.follows && rests) {
        float exposed = params.exposureChange;
        past = imageLoad(previousChanges, pixel) * vec4(exposed, exposed * exposed, exposed, 1.0);
        past *= float(1u - params.resized);
    }
    float frames = min(past.a + 1.0, lastingFrames);
    float off = past.a > 0.0 ? luma - past.x : 0.0;
    float variance = mix(past.y, off * off, 1.0 / frames);
    float recent = mix(past.z, off, recentShare);
    float known = past.a >= fewestFrames ? float(params.mayChange) : 0.0;
    float stale = known * staleness(staleShare(recent, variance, luma), staleLimits);
    float lit = past.x + off * stale;
    imageStore(changes, pixel, roundToHalf(vec4(lit + (luma - lit) / frames, variance, recent, frames)));
    float relit = past.a > 0.0 && stale > 0.0 ? clamp(lit / max(past.x, 1e-6), 1.0 / mostRelit, mostRelit) : 1.0;
    return Changed(stale, relit);
}

#endif
