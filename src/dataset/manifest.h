// Assigns scenes to the frames of a data set, and writes its manifest and records.
#pragma once

#include "dataset/options.h"
#include "scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace reflet {

/// Bursts are dealt to scenes in turns, shifted by one each round, so that every share gets all scenes.
class DatasetPlan {
public:
    /// Throws UsageError for options that exclude each other.
    explicit DatasetPlan(const DatasetOptions& options);

    /// "cubes", or the stem of a file; a second one of that name is "cubes-2".
    [[nodiscard]] const std::vector<std::string>& sceneNames() const { return names_; }
    [[nodiscard]] uint32_t sceneOf(uint32_t frame) const;
    [[nodiscard]] std::vector<uint32_t> sceneOfFrames() const;
    [[nodiscard]] uint32_t indexInScene(uint32_t burst) const { return burst / scenes(); }
    /// At least those that it has.
    [[nodiscard]] uint32_t burstsOfScene(uint32_t scene) const;

private:
    [[nodiscard]] uint32_t scenes() const { return static_cast<uint32_t>(names_.size()); }

    std::vector<std::string> names_;
    uint32_t frames_;
    uint32_t burst_;
};

/// "16" is 16 samples per pixel; 0: it is no number.
uint32_t samplesOf(const std::string& noisy);

/// Seed of a traced image: other noise in each frame and version. version 0: the clean one.
uint32_t traceSeed(uint32_t seed, uint32_t frame, uint32_t version);

/// Writes manifest.json of a new data set, or checks that the existing one is of the same. Throws Error with the
/// differences. Several processes may call it at once.
void beginDataset(const DatasetOptions& options, const DatasetPlan& plan, const std::vector<std::string>& environments);

/// Time, camera as in view files, matrices and sun. Both views posed. Matrices are lists of rows, for column vectors,
/// from the coordinates of the scene's file.
void addView(nlohmann::ordered_json& record, const View& now, const View& before, uvec2 size);

}  // namespace reflet
