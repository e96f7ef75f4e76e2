// The views of a sequence's frames: time advances, and the camera stands still, orbits or follows keyframes.
#pragma once

#include "job/sequence_options.h"
#include "scene/camera_path.h"
#include "scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace reflet {

class SequenceViews {
public:
    /// first: view of the first frame. Throws Error for a bad path file, and UsageError if the last frame's time is too
    /// late.
    SequenceViews(const View& first, const Scene& scene, const SequenceOptions& options, uint32_t frames);

    /// frame: counted from 0.
    [[nodiscard]] View of(uint32_t frame) const { return at(frame); }
    /// The view at a fractional frame number. Nothing moves before the time 0.
    [[nodiscard]] View at(double frame) const;
    /// The frames before which the camera jumps: it moves or turns much farther than in the frames around.
    [[nodiscard]] std::vector<uint32_t> cuts(const Scene& scene) const;

private:
    View first_;
    double fps_;
    uint32_t frames_;
    std::optional<vec3> pivot_;
    std::optional<CameraPath> path_;
};

/// The camera's path for the sequence's record: all inputs of the views besides the first one.
nlohmann::ordered_json pathRecord(const SequenceOptions& options, uint32_t frames);

}  // namespace reflet
