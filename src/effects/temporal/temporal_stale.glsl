// Whether a mean over frames is stale, by the differences of the frames from it.
#ifndef REFLET_TEMPORAL_STALE_GLSL
#define REFLET_TEMPORAL_STALE_GLSL

const float recentShare = 0.25;  // weight of a frame in the recent mean difference

// Differences that keep the same sign tell of a change, those that alternate of jitter: the squared recent mean
// difference over the variance, 0 to 1. Differences of less than a hundredth of the luma are rounding.
float staleShare(float recent, float variance, float luma) {
    return recent * recent / (variance + 1e-4 * luma * luma + 1e-8);
}

// 0 up to limits.x, 1 from limits.y.
float ramp(float v, vec2 limits) { return clamp((v - limits.x) / (limits.y - limits.x), 0.0, 1.0); }

#endif
