// Draws views.
#include "dataset/views.h"

#include "base/error.h"
#include "dataset/free_space.h"
#include "reference/reference.h"
#include "scene/default_light.h"
#include "scene/pose.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace reflet {

namespace {

namespace fs = std::filesystem;

constexpr int mostDarkViews = 8;

// At least 5 degrees above the horizon.
vec3 drawnSunDirection(Draws& draws) {
    for (;;) {
        vec3 up = draws.direction();
        up.y = std::abs(up.y);
        if (up.y > 0.087F) {
            return -up;
        }
    }
}

// Whether light reaches the image at all: behind an unlit wall, under a black sky, all is black.
bool showsLight(const View& view, const DatasetScene& scene, TimedScene& timed) {
    ReferenceOptions few;
    few.samples = 16;
    few.threads = 1;
    const ReferencePicture seen = traceReference(timed.at(view.time), posed(view, scene.scene), uvec2(16, 9), few);
    return std::ranges::any_of(seen.final.data, [](float value) { return value > 0.0F; });
}

bool isImage(const fs::path& file) {
    return file.extension() == ".hdr" || file.extension() == ".exr";
}

}  // namespace

const RayScene& TimedScene::at(double time) {
    const double asked = scene_.nodes.empty() ? 0.0 : time;
    const auto found = std::ranges::find(baked_, asked, &Baked::time);
    if (found != baked_.end()) {
        return *found->rays;
    }
    constexpr size_t most = 4;
    if (baked_.size() == most) {
        baked_.pop_front();
    }
    Baked baked{asked, nullptr, nullptr};
    if (!scene_.nodes.empty()) {
        baked.scene = std::make_unique<Scene>(frozen(scene_, time));
    }
    baked.rays = std::make_unique<RayScene>(baked.scene ? *baked.scene : scene_);
    return *baked_.emplace_back(std::move(baked)).rays;
}

EnvironmentPool::EnvironmentPool(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        if (!fs::is_directory(name)) {
            names_.push_back(name);
            continue;
        }
        std::vector<std::string> files;
        for (const auto& entry : fs::directory_iterator(name)) {
            if (entry.is_regular_file() && isImage(entry.path())) {
                files.push_back(entry.path().string());
            }
        }
        if (files.empty()) {
            failUsage("--environments {}: the folder has no .hdr or .exr file", name);
        }
        std::ranges::sort(files);
        names_.insert(names_.end(), files.begin(), files.end());
    }
    read_.resize(names_.size());
}

void EnvironmentPool::apply(uint32_t index, float rotation, View& view) {
    const std::string& name = names_[index];
    if (isMadeEnvironment(name) || name == "none") {
        chooseEnvironment(view, {.name = name, .base = {}, .keepsSun = !view.hasDefaultSun});
        return;
    }
    if (!read_[index]) {
        View only = view;
        chooseEnvironment(only, {.name = name, .base = {}, .keepsSun = false});
        read_[index] = only.environment;
    }
    view.environment = *read_[index];
    view.environment.rotation = rotation;
    if (view.hasDefaultSun) {
        view.sun.irradiance = vec3(0.0F);
    }
}

ViewDraw parseViewDraw(const DatasetOptions& o) {
    if (o.cameras != "random" && o.burst > 1) {
        failUsage("--burst is for --cameras random: the frames of a path follow each other already");
    }
    if ((o.cameras == "path") != !o.path.empty()) {
        failUsage("--cameras path needs --path FILE.json, and no other cameras take it");
    }
    return {parseDistribution("--height", o.height, heightDistributions(), 0.001, 1e6),
            parseDistribution("--fov", o.fov, fovDistributions(), 1.0, 170.0),
            parseDistribution("--exposure", o.exposure, {}, -20.0, 20.0)};
}

Shot::Shot(const DatasetOptions& options, const ViewDraw& draw, const DatasetScene& scene, TimedScene& timed,
           EnvironmentPool& environments, uint32_t burst, uint32_t index, const SequenceViews& path)
    : first_(scene.view), index_(static_cast<int>(index)), fps_(options.fps) {
    Draws draws(options.view.seed, burst);
    if (options.cameras == "random") {
        for (int i = 0; i == 0 || (i < mostDarkViews && !showsLight(first_, scene, timed)); ++i) {
            first_ = scene.view;
            drawCamera(options, draw, scene, timed, draws);
            drawLight(options, environments, draws);
        }
    } else {
        path_ = &path;
        drawLight(options, environments, draws);
    }
    exposure_ = draw.exposure.draw(draws);
}

void Shot::drawCamera(const DatasetOptions& options, const ViewDraw& draw, const DatasetScene& scene, TimedScene& timed,
                      Draws& draws) {
    // Not at the start, so that there is a frame before.
    first_.time += 1.0 / fps_ + animationDuration(scene.scene) * draws.unit();
    const Camera start = posed(first_, scene.scene).camera;
    const uvec2 size = parseSize(options.view.size);
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    const auto found = findCamera(timed.at(first_.time), start, aspect, draw.height, draw.fov, draws);
    first_.camera = found ? found->camera : start;
    first_.camera.node = -1;
    tries_ = found ? found->tries : 0;
    const float distance = found ? found->distance : glm::length(start.target - start.position);
    const auto speed = static_cast<float>(options.speed * draws.between(0.0, 0.5));  // distances per second
    velocity_ = draws.direction() * vec3(1.0F, 0.3F, 1.0F) * distance * speed;
    turning_ = vec2(draws.between(-0.6, 0.6), draws.between(-0.15, 0.15)) * static_cast<float>(options.speed);
}

void Shot::drawLight(const DatasetOptions& options, EnvironmentPool& environments, Draws& draws) {
    if (options.sun == "random") {
        first_.sun.direction = drawnSunDirection(draws);
        first_.sun.node = -1;
        if (first_.sun.irradiance == vec3(0.0F) && environments.names().empty()) {
            first_.sun.irradiance = vec3(pi);
        }
        if (first_.environment.imageFile == "sky") {
            chooseEnvironment(first_, {.name = "sky", .base = {}, .keepsSun = !first_.hasDefaultSun});
        }
    }
    if (const auto count = static_cast<uint32_t>(environments.names().size()); count > 0) {
        const uint32_t chosen = draws.below(count);
        environments.apply(chosen, static_cast<float>(draws.between(0.0, 2.0 * pi)), first_);
        environment_ = environments.names()[chosen];
    }
}

View Shot::at(double frame) const {
    View view = first_;
    if (path_ != nullptr) {
        const View on = path_->at(std::max(index_ + frame, 0.0));
        view.camera = on.camera;
        view.time = on.time;
        return view;
    }
    const double seconds = frame / fps_;
    view.time = std::max(first_.time + seconds, 0.0);
    const auto t = static_cast<float>(seconds);
    const vec3 ahead = view.camera.target - view.camera.position;
    const vec3 right = glm::normalize(glm::cross(ahead, view.camera.up));
    const glm::quat turn = glm::angleAxis(turning_.x * t, view.camera.up) * glm::angleAxis(turning_.y * t, right);
    view.camera.position += velocity_ * t;
    view.camera.target = view.camera.position + turn * ahead;
    return view;
}

}  // namespace reflet
