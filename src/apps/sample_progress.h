// Progress of path tracing: samples, and the noise that is left.
#pragma once

#include "apps/progress.h"
#include "reference/reference.h"

#include <string>

namespace reflet {

/// The most samples per pixel that may be asked for.
constexpr uint32_t largestSamples = 1U << 20U;

/// Shows how many samples are done. Of those that a noise takes nobody knows the number, but that noise falls with its
/// root.
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
