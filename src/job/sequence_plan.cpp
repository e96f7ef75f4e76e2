// Plans segments of a sequence.
#include "job/sequence_plan.h"

#include <algorithm>
#include <iterator>

namespace reflet {

std::vector<SequencePlan::Run> SequencePlan::runs(Share share,
                                                  const std::function<bool(uint32_t frame)>& isMissing) const {
    std::vector<Run> result;
    const uint64_t stride = uint64_t(segment) * share.count;
    for (uint64_t start = uint64_t(segment) * share.index; start < frames; start += stride) {
        Run run{static_cast<uint32_t>(start), static_cast<uint32_t>(std::min<uint64_t>(start + segment, frames))};
        while (run.end > run.begin && !isMissing(run.end - 1)) {
            --run.end;
        }
        for (const uint32_t cut : cuts) {
            if (cut > run.begin && cut < run.end) {
                result.push_back({run.begin, cut});
                run.begin = cut;
            }
        }
        if (run.end > run.begin) {
            result.push_back(run);
        }
    }
    return result;
}

uint32_t SequencePlan::shotOf(uint32_t frame) const {
    const auto next = std::ranges::upper_bound(cuts, frame);
    return next == cuts.begin() ? 0 : *std::prev(next);
}

uint64_t SequencePlan::work(const std::vector<Run>& runs) const {
    uint64_t sum = 0;
    for (const Run& run : runs) {
        sum += uint64_t(warmUp) + run.end - run.begin;
    }
    return sum;
}

}  // namespace reflet
