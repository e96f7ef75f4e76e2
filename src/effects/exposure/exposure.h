// Automatic exposure: the log-average luminance of the surfaces in the picture becomes middle grey. Shared by C++ and
// GLSL.
//
// E. Reinhard, M. Stark, P. Shirley, J. Ferwerda: Photographic Tone Reproduction for Digital Images (2002), with a
// histogram instead of the mean over all pixels: the darkest and brightest pixels are cut off, so that deep shadows and
// lamps in the picture do not decide, and light tones have a limit. Black pixels do not count, and the background only
// where there is hardly a surface. All sums are of integers, so the order of the pixels does not matter.
#ifndef REFLET_EFFECTS_EXPOSURE_H
#define REFLET_EFFECTS_EXPOSURE_H

#include "base/shared.h"

SHARED_BEGIN

// Levels of luminance: 1/1024 stop, from the smallest half float on. A bin has 128 of them.
const int lowestStop = -24;
const int highestStop = 16;
const uint levelsPerStop = 1024u;
const uint levelsPerBin = 128u;
const uint meterBins = uint(highestStop - lowestStop) * levelsPerStop / levelsPerBin;

// The histogram: pixels per bin of surfaces, those of the background, and the sums of the pixels' levels within their
// bins in the same order.
const uint meterSurfaces = 0u;
const uint meterBackground = meterBins;
const uint meterSums = 2u * meterBins;
const uint meterSize = 2u * meterSums;

// Frames that the exposure is smoothed over: at most as many as `--warmup` renders by default before a segment of a
// sequence, so that segments fit together.
const uint exposureFrames = 16u;

// The image of the exposure, R: stops, G: age [s], negative: none. First the exposures that the last frames asked for,
// newest first, then the smoothed one.
const uint exposureTexels = exposureFrames + 1u;

struct MeterParams {
    uvec2 size;  // pixels
    uint step;   // every step-th pixel is metered, along each side
};

struct ExposureParams {
    float elapsed;      // seconds since the last frame, not negative
    float adaptation;   // seconds in which the weight of a frame falls to 1/e; 0: no smoothing
    uint hasPrevious;   // 1: `previous` holds the last frame's
    float preExposure;  // stops by which the metered radiance has been exposed already; exposures include them
};

SHARED_END

#ifdef __cplusplus

#include "base/image_file.h"
#include "gpu/recorder.h"

namespace reflet {

/// Every how many pixels, along each side, a picture of this size is metered: at 1280x720 every fourth.
uint32_t meterStep(uvec2 size);

/// R32G32_SFLOAT, exposureTexels wide; the last texel's R: stops by which the tone map multiplies the radiance.
/// `radiance`: RGBA16F; `depth`: 0 where there is no surface; `elapsed`: seconds since the last frame; `preExposure`:
/// stops that `radiance` has been multiplied by, as if it had not.
gpu::Image measureExposure(gpu::PassList& f, gpu::HistoryImage& own, gpu::Image radiance, gpu::Image depth,
                           float elapsed, float adaptation, float preExposure = 0.0F);

/// R32F, 1x1: the factor on radiance that measureExposure found.
gpu::Image exposureFactor(gpu::PassList& f, gpu::Image exposure);

/// Stops, from a read-back of that image.
float exposureOf(const gpu::Recorder& f, gpu::Readback exposure);

/// What measureExposure gives a first frame, within 0.002 stops. `radiance`: 3 channels; `depth`: 1 channel, 0 where
/// there is no surface, or empty: surfaces everywhere.
float meteredExposure(const FloatImage& radiance, const FloatImage& depth);

}  // namespace reflet
#endif

#endif
