// The views of a data set's frames: what is drawn at random, and what follows a path.
#pragma once

#include "dataset/draws.h"
#include "dataset/options.h"
#include "job/sequence_views.h"
#include "reference/ray_scene.h"

#include <deque>
#include <memory>
#include <optional>

namespace reflet {

struct DatasetScene {
    std::string name;  ///< of its folder and files
    SceneOptions options;
    Scene scene;
    View view;  ///< of loadView
};

/// A scene's hierarchies at several times. One of a scene without animation serves all.
class TimedScene {
public:
    explicit TimedScene(const Scene& scene) : scene_(scene) {}
    /// Valid until four other times have been asked for.
    const RayScene& at(double time);

private:
    struct Baked {
        double time = 0.0;
        std::unique_ptr<Scene> scene;
        std::unique_ptr<RayScene> rays;
    };

    const Scene& scene_;
    std::deque<Baked> baked_;
};

/// Environments to draw from.
class EnvironmentPool {
public:
    /// Names (sky, studio, none), files and folders, of which all .hdr and .exr files count, sorted. Throws UsageError.
    explicit EnvironmentPool(const std::vector<std::string>& names);

    /// As chooseEnvironment takes them.
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    /// Replaces the view's environment; images are turned. Files are read once.
    void apply(uint32_t index, float rotation, View& view);

private:
    std::vector<std::string> names_;
    std::vector<std::optional<Environment>> read_;
};

/// What the options say about cameras and light, checked.
struct ViewDraw {
    Distribution height;
    Distribution fov;
    Distribution exposure;  ///< stops
};
/// Throws UsageError.
ViewDraw parseViewDraw(const DatasetOptions& options);

/// The views of one burst. A burst of a path is one frame.
class Shot {
public:
    /// index: number of the burst in its scene, of `count`. Draws of a burst depend on the seed and its number alone.
    Shot(const DatasetOptions& options, const ViewDraw& draw, const DatasetScene& scene, TimedScene& timed,
         EnvironmentPool& environments, uint32_t burst, uint32_t index, const SequenceViews& path);

    /// The view of the burst's frame `frame`, between frames, or for negative steps of the frames before it. Not posed.
    [[nodiscard]] View at(double frame) const;
    [[nodiscard]] double exposure() const { return exposure_; }
    /// The drawn one; empty: the view's own.
    [[nodiscard]] const std::string& environment() const { return environment_; }
    /// How many cameras were drawn until one was good; 0: it is that of the scene, or of the path.
    [[nodiscard]] uint32_t tries() const { return tries_; }

private:
    void drawCamera(const DatasetOptions& options, const ViewDraw& draw, const DatasetScene& scene, TimedScene& timed,
                    Draws& draws);
    void drawLight(const DatasetOptions& options, EnvironmentPool& environments, Draws& draws);

    View first_;
    const SequenceViews* path_ = nullptr;  ///< null: the camera is drawn
    int index_ = 0;
    double fps_ = 24.0;
    vec3 velocity_{0.0F};  ///< metres per second
    vec2 turning_{0.0F};   ///< radians per second: to the left, up
    double exposure_ = 0.0;
    std::string environment_;
    uint32_t tries_ = 0;
};

}  // namespace reflet
