// Finds a sequence's missing files; checks options.
#include "job/sequence_files.h"

#include "base/error.h"
#include "base/image_file.h"
#include "job/sequence_record.h"
#include "job/sequence_views.h"
#include "job/share.h"
#include "version.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace reflet {

namespace fs = std::filesystem;

namespace {

void checkNumbers(const SequenceOptions& o, uint32_t frames) {
    if (!(o.fps > 0.0 && o.fps <= 1e6)) {
        failUsage("--fps must be more than 0 and at most 1e6, is {:g}", o.fps);
    }
    if (o.firstFrame > std::numeric_limits<uint32_t>::max() - frames) {
        failUsage("--first-frame {}: the numbers of {} frames do not fit in 32 bits", o.firstFrame, frames);
    }
    if (const Share share = parseShare(o.share); o.overwrite && share.count > 1) {
        failUsage(
            "--overwrite would remove the other shares' frames: remove all files by hand, or render without --share");
    }
}

}  // namespace

bool isSequence(const std::vector<std::string>& outputs, const SequenceOptions& options, uint32_t frames) {
    const auto single = std::ranges::find_if_not(outputs, FrameNames::isPattern);
    if (std::ranges::none_of(outputs, FrameNames::isPattern)) {
        return false;
    }
    if (single != outputs.end()) {
        failUsage("-o {}: either every name needs a run of # for the frame number, or none", *single);
    }
    checkNumbers(options, frames);
    return true;
}

SequenceFiles::SequenceFiles(const std::vector<std::string>& outputs, uint32_t firstFrame)
    : names_(outputs.begin(), outputs.end()), firstFrame_(firstFrame) {}

std::vector<fs::path> SequenceFiles::missing(uint32_t frame) const {
    std::vector<fs::path> files;
    for (const FrameNames& names : names_) {
        fs::path file = names.file(firstFrame_ + frame);
        // A folder of that name is no frame: writing it says that it is in the way. A file without its end, of a copy
        // or of a machine that lost power, is made anew.
        if (!isWholeImage(file)) {
            files.push_back(std::move(file));
        }
    }
    return files;
}

void noteEmptyShare(const SequencePlan& plan, Share share) {
    if (const uint32_t segments = plan.segments(); share.index >= segments) {
        printNote(fmt::format(
            "--share {}/{}: nothing to do, because {} frames are {} segment{} of {}; at most that many shares have "
            "work{}",
            share.index + 1, share.count, plan.frames, segments, segments == 1 ? "" : "s", plan.segment,
            plan.segment > 1 ? ": choose fewer, or a smaller --segment" : ""));
    }
}

nlohmann::ordered_json commonRecord(const SceneOptions& scene, const SequenceOptions& sequence, uint32_t frames,
                                    const View& view) {
    const uvec2 size = parseSize(scene.size);
    return {{"reflet", versionText},
            {"scene", fs::path(scene.scene).filename().string()},
            {"scene_fingerprint", sceneFingerprint(scene.scene)},
            {"scene_index", scene.sceneIndex.value_or(-1)},
            {"variant", scene.variant},
            {"animation", scene.animation},
            {"size", {size.x, size.y}},
            {"seed", scene.seed},
            {"first_frame", sequence.firstFrame},
            {"fps", sequence.fps},
            {"view", recordOf(view)},
            {"path", pathRecord(sequence, frames)}};
}

}  // namespace reflet
