// How the light of a surface's 3x3 neighbourhoods changes from frame to frame. The includer declares params as
// TemporalParams and the images previousChanges and changes: of the mean of steadyLight over the frames that showed the
// surface: mean, variance, recent mean difference, and their number, whose fraction is half of the unevenness in the last
// frame.
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

// Relative deviation of the light around a pixel. Less: noise, and how light falls off. More: an edge of a shadow.
const vec2 edgeLimits = vec2(0.15, 0.25);
const float mostUneven = 0.9;
// Of the change to that deviation: less is what jitter does.
const vec2 stepLimits = vec2(0.5, 1.0);
// Powers of two of a change in one frame: more is another light, with other shadows.
const vec2 otherLight = vec2(0.6, 1.2);

struct Changed {
    float disturbed;  // 0 to 1: edges of the light have moved, so that earlier frames are worth nothing; -1: it is the
                      // sky, whose motion is known exactly, and which does not change
    float relit;      // factor on what is kept of earlier frames
};

// Jitter changes the mean, too: only the differences of several frames together tell that light changed. Where it is
// even, and was, earlier frames then count as lit alike, so that the detail they have is kept.
// Neighbourhoods of frames of another size are others: what is known of them starts anew.
Changed changedAt(ivec2 pixel, vec2 light, Seen now) {
    if (now.sky) {
        imageStore(changes, pixel, vec4(0.0));
        return Changed(-1.0, 1.0);
    }
    float luma = light.x;
    float uneven = min(light.y, mostUneven);
    vec4 past = vec4(0.0);
    // Of what moves, even slowly, neighbourhoods are never the same.
    bool rests = length(now.moved * vec2(params.size)) < asGoodAsStill;
    if (now.follows && rests) {
        float exposed = params.exposureChange;
        past = imageLoad(previousChanges, pixel) * vec4(exposed, exposed * exposed, exposed, 1.0);
        past *= float(1u - params.resized);
    }
    float unevenBefore = 2.0 * fract(past.a);
    past.a = floor(past.a);
    float frames = min(past.a + 1.0, lastingFrames);
    float off = past.a > 0.0 ? luma - past.x : 0.0;
    float variance = mix(past.y, off * off, 1.0 / frames);
    float recent = mix(past.z, off, recentShare);
    float known = past.a >= fewestFrames ? float(params.mayChange) : 0.0;
    float stale = known * ramp(staleShare(recent, variance, luma), staleLimits);
    float lit = past.x + off * stale;
    imageStore(changes, pixel,
               roundToHalf(vec4(lit + (luma - lit) / frames, variance, recent, frames + 0.5 * uneven)));
    float relit = past.a > 0.0 && stale > 0.0 ? clamp(lit / max(past.x, 1e-6), 1.0 / mostRelit, mostRelit) : 1.0;
    float most = max(uneven, unevenBefore);
    float edge = ramp(most, edgeLimits) * ramp(abs(off) / max(most * max(luma, past.x), 1e-6), stepLimits);
    float other = ramp(abs(log2(relit)), otherLight);
    return Changed(stale * max(edge, other), relit);
}

#endif
