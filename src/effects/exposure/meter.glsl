// Metering: from luminance to levels, and from a histogram of levels to an exposure. Compiled as GLSL by meter.comp and
// exposure.comp and as C++ by meter_image.cpp, so that CPU and GPU results match. Where it is included, `meterCount(i)`
// must return a number of the histogram.
#ifndef REFLET_METER_GLSL
#define REFLET_METER_GLSL

#include "effects/exposure/exposure.h"

// The neutral curve subtracts 0.04: it shows this as 0.18.
const float middleGrey = 0.22f;
// The mean of the light tones is at most this, so that what is lit is not burnt where most is in shadow.
const float lightestGrey = 0.6f;
// Shares of the pixels that are not black, from dark to bright: the mean is over those from the first to the last;
// light tones are those from the second on.
const float darkestShare = 0.1f;
const float lightShare = 0.7f;
const float brightestShare = 0.9f;
// Highlights keep their drawing: so many pixels of surfaces may be lighter than this, as far as a stop less is enough.
const float lightestHighlight = 3.0f;
const float highlightShare = 0.99f;
// The mean of a background that fills this share of the pixels is at most this, so that the sky behind black things is
// not burnt. With a smaller share, as of a window, it may be lighter by so many stops.
const float lightestBackground = 0.6f;
const float windowShare = 0.15f;
const float backgroundShare = 0.45f;
const float windowStops = 4.0f;
// Surfaces with this share of the pixels that are not black decide alone.
const float enoughSurface = 0.01f;

// Level of a luminance; negative: black, or not a number.
int meterLevel(float luminance) {
    if (!(luminance >= exp2(float(lowestStop)))) {
        return -1;
    }
    float stops = min(log2(luminance), float(highestStop)) - float(lowestStop);
    return min(int(stops * float(levelsPerStop) + 0.5f), int(meterBins * levelsPerBin) - 1);
}

// Number of pixels of a kind: meterSurfaces or meterBackground.
uint meterTotal(uint kind) {
    uint total = 0u;
    for (uint i = 0u; i < meterBins; ++i) {
        total += meterCount(kind + i);
    }
    return total;
}

// Mean log2 luminance of the pixels of a kind between two shares of them, sorted by luminance.
float meterMean(uint kind, uint total, float from, float to) {
    float first = from * float(total);
    float last = to * float(total);
    float below = 0.0f;
    float sum = 0.0f;
    for (uint i = 0u; i < meterBins; ++i) {
        float count = float(meterCount(kind + i));
        float inside = min(below + count, last) - max(below, first);
        if (inside > 0.0f) {
            float level = float(i * levelsPerBin) + float(meterCount(meterSums + kind + i)) / count;
            sum += inside * (level / float(levelsPerStop));
        }
        below += count;
    }
    return sum / (last - first) + float(lowestStop);
}

// Stops that make the mean middle grey, unless light tones would become too light. 0 where all is black.
float exposureFor(uint kind, uint total) {
    if (total == 0u) {
        return 0.0f;
    }
    float ofTones = min(log2(middleGrey) - meterMean(kind, total, darkestShare, brightestShare),
                        log2(lightestGrey) - meterMean(kind, total, lightShare, brightestShare));
    float margin = 0.5f * (1.0f - highlightShare);
    float highlights = meterMean(kind, total, highlightShare - margin, highlightShare + margin);
    return min(ofTones, max(log2(lightestHighlight) - highlights, ofTones - 1.0f));
}

// Stops for the whole histogram.
float meteredExposure() {
    uint surfaces = meterTotal(meterSurfaces);
    uint background = meterTotal(meterBackground);
    float ofSurfaces = exposureFor(meterSurfaces, surfaces);
    if (background == 0u) {
        return ofSurfaces;
    }
    float all = float(surfaces + background);
    float slack = windowStops * (1.0f - smoothstep(windowShare, backgroundShare, float(background) / all));
    float seen = meterMean(meterBackground, background, darkestShare, brightestShare);
    float limit = log2(lightestBackground) - seen + slack;
    float weight = min(float(surfaces) / (enoughSurface * all), 1.0f);
    return mix(exposureFor(meterBackground, background), min(ofSurfaces, limit), weight);
}

#endif
