// The files of a sequence that is being rendered: which exist, which are missing. Processes share only the files and
// their record, so several can render one sequence, and any of them may end at any time.
#pragma once

#include "job/scene_options.h"
#include "job/sequence_names.h"
#include "job/sequence_options.h"
#include "job/sequence_plan.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace reflet {

class SequenceFiles {
public:
    /// outputs: names with a run of #. Throws UsageError.
    SequenceFiles(const std::vector<std::string>& outputs, uint32_t firstFrame);

    [[nodiscard]] const std::vector<FrameNames>& names() const { return names_; }

    /// Files of a frame, counted from 0, that do not exist at this moment or are incomplete.
    [[nodiscard]] std::vector<std::filesystem::path> missing(uint32_t frame) const;
    [[nodiscard]] bool isMissing(uint32_t frame) const { return !missing(frame).empty(); }

private:
    std::vector<FrameNames> names_;
    uint32_t firstFrame_;
};

/// Prints a note if the share has no segment of the plan.
void noteEmptyShare(const SequencePlan& plan, Share share);

/// The part of the record that all sequences have: scene, view, size, seed, frame times, path.
nlohmann::ordered_json commonRecord(const SceneOptions& scene, const SequenceOptions& sequence, uint32_t frames,
                                    const View& view);

}  // namespace reflet
