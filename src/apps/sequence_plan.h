// Which frames of a sequence are rendered one after another. Frames that depend on those before them are cut into
// segments, each of which begins from nothing: so a part of them gives the same pictures as all of them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace reflet {

/// One of `count` equal shares, from 0.
struct Share {
    uint32_t index = 0;
    uint32_t count = 1;
};

/// "3/16" is the third of sixteen; "" is all. Throws UsageError.
Share parseShare(const std::string& text);

struct SequencePlan {
    uint32_t frames = 1;
    uint32_t segment = 1;  ///< frames, at least 1
    uint32_t warmUp = 0;   ///< frames rendered before each segment

    /// Frames [begin, end), counted from 0, to be rendered one after another.
    struct Run {
        uint32_t begin = 0;
        uint32_t end = 0;
    };

    /// Segments are dealt to the shares in turn. Those of a share that have a missing frame, up to the last of these.
    [[nodiscard]] std::vector<Run> runs(Share share, const std::function<bool(uint32_t frame)>& isMissing) const;
    /// Frames to be rendered, those before the segments included.
    [[nodiscard]] uint64_t work(const std::vector<Run>& runs) const;
};

}  // namespace reflet
