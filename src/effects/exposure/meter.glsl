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
const float highlightMargin = 0.5f * (1.0f - highlightShare);
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

// Sum of the levels of the pixels of a kind between two of them, sorted by luminance, that are in bins from `bin` to
// `end`, exclusive. `before`: pixels in the bins before.
float meterPart(uint kind, uint bin, uint end, uint before, float first, float last) {
    float below = float(before);
    float sum = 0.0f;
    for (uint i = bin; i < end; ++i) {
        float count = float(meterCount(kind + i));
        float inside = min(below + count, last) - max(below, first);
        if (inside > 0.0f) {
            float level = float(i * levelsPerBin) + float(meterCount(meterSums + kind + i)) / count;
            sum += inside * (level / float(levelsPerStop));
        }
        below += count;
    }
    return sum;
}

// Mean log2 luminance of `pixels` from the sum of their levels.
float meterMean(float sum, float pixels) {
    return sum / pixels + float(lowestStop);
}

// Means of a kind: of all of its tones, of the light ones, and about the share of the highlights.
const uint meterMeans = 3u;

float firstShare(uint mean) {
    return mean == 0u ? darkestShare : mean == 1u ? lightShare : highlightShare - highlightMargin;
}

float lastShare(uint mean) {
    return mean < 2u ? brightestShare : highlightShare + highlightMargin;
}

// Stops that make the mean middle grey, unless light tones or highlights would become too light. 0 where all is black.
float exposureFor(uint total, float mean, float lightMean, float highlights) {
    if (total == 0u) {
        return 0.0f;
    }
    float ofTones = min(log2(middleGrey) - mean, log2(lightestGrey) - lightMean);
    return min(ofTones, max(log2(lightestHighlight) - highlights, ofTones - 1.0f));
}

// Stops for all, from those for surfaces and for the background, of which there are so many pixels. backgroundMean: of
// its tones.
float exposureForAll(uint surfaces, float ofSurfaces, uint background, float ofBackground, float backgroundMean) {
    if (background == 0u) {
        return ofSurfaces;
    }
    float all = float(surfaces + background);
    float slack = windowStops * (1.0f - smoothstep(windowShare, backgroundShare, float(background) / all));
    float limit = log2(lightestBackground) - backgroundMean + slack;
    float weight = min(float(surfaces) / (enoughSurface * all), 1.0f);
    return mix(ofBackground, min(ofSurfaces, limit), weight);
}

#endif
