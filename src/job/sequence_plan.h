// Plans which frames of a sequence are rendered consecutively. Frames that depend on earlier ones are cut into
// segments, each of which starts with an empty history. So rendering a part of the sequence gives the same images as
// rendering all of it.
#pragma once

#include "job/share.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace reflet {

struct SequencePlan {
    uint32_t frames = 1;
    uint32_t segment = 1;        ///< frames per segment, at least 1
    uint32_t warmUp = 0;         ///< frames rendered before each segment and each shot
    std::vector<uint32_t> cuts;  ///< first frames of all shots but the first, ascending: they have no history either

    /// Frames [begin, end), counted from 0, to be rendered consecutively.
    struct Run {
        uint32_t begin = 0;
        uint32_t end = 0;
    };

    /// Distributes segments to the shares round-robin. Returns the share's segments with missing frames, each cut off
    /// after its last missing frame, and split into shots.
    [[nodiscard]] std::vector<Run> runs(Share share, const std::function<bool(uint32_t frame)>& isMissing) const;
    /// The first frame of the shot that the frame belongs to.
    [[nodiscard]] uint32_t shotOf(uint32_t frame) const;
    [[nodiscard]] uint32_t segments() const { return frames / segment + (frames % segment != 0 ? 1 : 0); }
    /// Number of frames to render, including warm-up frames.
    [[nodiscard]] uint64_t work(const std::vector<Run>& runs) const;
};

}  // namespace reflet
