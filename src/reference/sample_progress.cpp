// Progress of path tracing.
#include "reference/sample_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace reflet {

SampleProgress::SampleProgress(const std::string& what, const ReferenceOptions& options, uvec2 size)
    : options_(options), pixels_(uint64_t(size.x) * size.y), shown_(what + ": sample", options.samples) {}

void SampleProgress::set(const ReferenceProgress& now) {
    const uint64_t done = now.done / pixels_;
    if (options_.noise > 0.0F && now.noise != noise_) {
        const double times = now.noise / options_.noise;
        const double needed = std::ceil(static_cast<double>(done) * times * times);
        shown_.expect(static_cast<uint64_t>(std::min(needed, double(options_.samples))));
    }
    noise_ = now.noise;
    shown_.set(done, noise_ > 0.0 ? fmt::format("noise {:.2g}", noise_) : "");
}

}  // namespace reflet
