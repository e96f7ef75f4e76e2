// Computes the views of a sequence's frames.
#include "job/sequence_views.h"

#include "base/error.h"
#include "base/json.h"
#include "scene/pose.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace reflet {

namespace {

constexpr std::string_view orbitPath = "orbit";

// How far a camera goes from frame to frame: radians that it turns, and the way relative to the distance of its target.
// A jump is at least smallestJump, and muchFarther times what the frames around it do.
constexpr float smallestJump = 0.1F;
constexpr float muchFarther = 6.0F;

float wayBetween(const Camera& a, const Camera& b) {
    const vec3 from = a.target - a.position;
    const vec3 to = b.target - b.position;
    const float turn = std::acos(std::clamp(glm::dot(glm::normalize(from), glm::normalize(to)), -1.0F, 1.0F));
    const float distance = std::max(std::min(glm::length(from), glm::length(to)), 1e-6F);
    return turn + glm::length(b.position - a.position) / distance;
}

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

View SequenceViews::at(double frame) const {
    View view = first_;
    view.time = std::clamp(view.time + frame / fps_, 0.0, View::largestTime);
    if (pivot_) {
        view.camera = orbit(view.camera, *pivot_, frame / frames_);
    } else if (path_) {
        view.camera = path_->at(view.time);
    }
    return view;
}

std::vector<uint32_t> SequenceViews::cuts(const Scene& scene) const {
    std::vector<float> ways{0.0F};  // to each frame
    Camera last = posed(of(0), scene).camera;
    for (uint32_t frame = 1; frame < frames_; ++frame) {
        const Camera now = posed(of(frame), scene).camera;
        ways.push_back(wayBetween(last, now));
        last = now;
    }
    std::vector<uint32_t> found;
    for (uint32_t frame = 1; frame < frames_; ++frame) {
        const float around = std::max(ways[frame - 1], frame + 1 < frames_ ? ways[frame + 1] : 0.0F);
        if (ways[frame] > std::max(smallestJump, muchFarther * around)) {
            found.push_back(frame);
        }
    }
    return found;
}

nlohmann::ordered_json pathRecord(const SequenceOptions& options, uint32_t frames) {
    if (options.path == orbitPath) {
        return {{"orbit_frames", frames}};
    }
    return options.path.empty() ? nlohmann::json() : parseJsonFile(options.path);
}

}  // namespace reflet
