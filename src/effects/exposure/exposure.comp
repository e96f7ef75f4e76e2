// The exposure that this frame's histogram asks for, and its mean with those of the last frames. One group.
// In: histogram; the last frame's exposures. Out: this frame's.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/exposure/exposure.h"

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { ExposureParams params; };
layout(scalar) readonly buffer HistogramBlock { uint numbers[meterSize]; } histogram;
layout(rg32f) uniform readonly image2D previous;
layout(rg32f) uniform writeonly image2D next;

shared uint numbers[meterSize];

uint meterCount(uint i) { return numbers[i]; }
#include "effects/exposure/meter.glsl"

// Each lane has a few bins. Rows are the means of the surfaces and of the background.
const uint lanes = gl_WorkGroupSize.x;
const uint laneBins = meterBins / lanes;
const uint rows = 2u * meterMeans;
shared uint counts[2][lanes];
shared float parts[rows][lanes];
shared float means[rows];
shared vec2 past[exposureFrames];  // weighted exposure, weight

uint kindOf(uint row) { return row < meterMeans ? meterSurfaces : meterBackground; }

uint total(uint row) {
    uint sum = 0u;
    for (uint i = 0u; i < lanes; ++i) {
        sum += counts[row / meterMeans][i];
    }
    return sum;
}

float weightOf(float age) {
    return params.adaptation > 0.0 ? exp(-age / params.adaptation) : 0.0;
}

void loadHistogram(uint lane) {
    for (uint i = lane; i < meterSize; i += lanes) {
        numbers[i] = histogram.numbers[i];
    }
    barrier();
    for (uint row = 0u; row < rows; row += meterMeans) {
        uint count = 0u;
        for (uint i = 0u; i < laneBins; ++i) {
            count += meterCount(kindOf(row) + lane * laneBins + i);
        }
        counts[row / meterMeans][lane] = count;
    }
    barrier();
}

// Each lane its part of the sums, then each of the first lanes a row. In this order on every device.
void findMeans(uint lane) {
    for (uint row = 0u; row < rows; ++row) {
        uint before = 0u;
        for (uint i = 0u; i < lane; ++i) {
            before += counts[row / meterMeans][i];
        }
        float all = float(total(row));
        parts[row][lane] = meterPart(kindOf(row), lane * laneBins, (lane + 1u) * laneBins, before,
                                     firstShare(row % meterMeans) * all, lastShare(row % meterMeans) * all);
    }
    barrier();
    if (lane < rows) {
        float sum = 0.0;
        for (uint i = 0u; i < lanes; ++i) {
            sum += parts[lane][i];
        }
        float all = float(total(lane));
        uint mean = lane % meterMeans;
        means[lane] = meterMean(sum, lastShare(mean) * all - firstShare(mean) * all);
    }
}

// The exposures that earlier frames asked for, one a lane, are a frame older.
void agePast(uint lane) {
    if (lane >= 1u && lane < exposureFrames) {
        vec2 old = params.hasPrevious != 0u ? imageLoad(previous, ivec2(lane - 1u, 0)).rg : vec2(0.0, -1.0);
        bool known = old.y >= 0.0;
        old.y += known ? params.elapsed : 0.0;
        float weight = known ? weightOf(old.y) : 0.0;
        past[lane] = vec2(known ? old.x * weight : 0.0, weight);
        imageStore(next, ivec2(lane, 0), vec4(old, 0.0, 0.0));
    }
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    loadHistogram(lane);
    findMeans(lane);
    agePast(lane);
    barrier();
    if (lane > 0u) {
        return;
    }
    uint surfaces = total(0u);
    uint background = total(meterMeans);
    float ofSurfaces = exposureFor(surfaces, means[0], means[1], means[2]);
    float ofBackground = exposureFor(background, means[3], means[4], means[5]);
    float own = exposureForAll(surfaces, ofSurfaces, background, ofBackground, means[3]) + params.preExposure;
    imageStore(next, ivec2(0), vec4(own, 0.0, 0.0, 0.0));
    float sum = own;
    float weights = 1.0;
    for (uint i = 1u; i < exposureFrames; ++i) {
        sum += past[i].x;
        weights += past[i].y;
    }
    imageStore(next, ivec2(exposureFrames, 0), vec4(sum / weights, 0.0, 0.0, 0.0));
}
