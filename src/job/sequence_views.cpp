// Computes the views of a sequence's frames.
#include "job/sequence_views.h"

#include "base/error.h"
#include "base/json.h"
#include "scene/pose.h"

#include <nlohmann/json.hpp>

#include <string_view>

namespace reflet {

namespace {

constexpr std::string_view orbitPath = "orbit";

}  // namespace

SequenceViews::SequenceViews(const View& first, const Scene& scene, const SequenceOptions& options, uint32_t frames)
    : first_(first), fps_(options.fps), frames_(frames) {
    if (options.path == orbitPath) {
        first_.camera = posed(first_, scene).camera;
        pivot_ = scene.nodes.empty() ? orbitPivot(first_.camera, scene)
                                     : orbitPivot(first_.camera, frozen(scene, first_.time));
    } else if (!options.path.empty()) {
        path_ = loadCameraPath(options.path, first_.camera, first_.origin);
        path_->checkFocus(scene, options.path);
    }
    if (const double last = first_.time + (frames - 1) / fps_; last > View::largestTime) {
        failUsage("the last frame is at {:g} seconds; the largest time is {:g}", last, View::largestTime);
    }
}

View SequenceViews::of(uint32_t frame) const {
    View view = first_;
    view.time += frame / fps_;
    if (pivot_) {
        view.camera = orbit(view.camera, *pivot_, static_cast<double>(frame) / frames_);
    } else if (path_) {
        view.camera = path_->at(view.time);
    }
    return view;
}

nlohmann::ordered_json pathRecord(const SequenceOptions& options, uint32_t frames) {
    if (options.path == orbitPath) {
        return {{"orbit_frames", frames}};
    }
    return options.path.empty() ? nlohmann::json() : parseJsonFile(options.path);
}

}  // namespace reflet
