// Plans segments and shares of a sequence.
#include "capture/sequence_plan.h"

#include "base/error.h"

#include <algorithm>
#include <charconv>

namespace reflet {

Share parseShare(const std::string& text) {
    if (text.empty()) {
        return {};
    }
    uint32_t number = 0;
    Share share;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, number);
    if (first.ec == std::errc() && first.ptr != end && *first.ptr == '/') {
        const auto second = std::from_chars(first.ptr + 1, end, share.count);
        if (second.ec == std::errc() && second.ptr == end && number >= 1 && number <= share.count) {
            share.index = number - 1;
            return share;
        }
    }
    failUsage("--share must be K/N with K from 1 to N, as in 3/16, is '{}'", text);
}

std::vector<SequencePlan::Run> SequencePlan::runs(Share share,
                                                  const std::function<bool(uint32_t frame)>& isMissing) const {
    std::vector<Run> result;
    const uint64_t stride = uint64_t(segment) * share.count;
    for (uint64_t start = uint64_t(segment) * share.index; start < frames; start += stride) {
        Run run{static_cast<uint32_t>(start), static_cast<uint32_t>(std::min<uint64_t>(start + segment, frames))};
        while (run.end > run.begin && !isMissing(run.end - 1)) {
            --run.end;
        }
        if (run.end > run.begin) {
            result.push_back(run);
        }
    }
    return result;
}

uint64_t SequencePlan::work(const std::vector<Run>& runs) const {
    uint64_t sum = 0;
    for (const Run& run : runs) {
        sum += uint64_t(warmUp) + run.end - run.begin;
    }
    return sum;
}

}  // namespace reflet
