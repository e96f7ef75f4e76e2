// Progress of path tracing: samples done, and the remaining noise.
#pragma once

#include "base/progress.h"
#include "reference/reference.h"

#include <string>

namespace reflet {

/// The largest number of samples per pixel that can be requested.
constexpr uint32_t largestSamples = 1U << 20U;

/// Shows how many samples are done. The number of samples for a target noise is estimated: noise falls with the square
/// root of the samples.
class SampleProgress {
public:
    /// `options` must outlive it.
    SampleProgress(const std::string& what, const ReferenceOptions& options, uvec2 size);

    void set(const ReferenceProgress& now);

private:
    const ReferenceOptions& options_;
    uint64_t pixels_;
    double noise_ = 0.0;
    Progress shown_;
};

}  // namespace reflet
