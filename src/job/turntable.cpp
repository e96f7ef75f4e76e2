// Renders turntables.
#include "job/turntable.h"

#include "base/error.h"
#include "base/interrupt.h"
#include "base/progress.h"
#include "job/noise_meter.h"
#include "job/sequence_files.h"
#include "job/sequence_plan.h"
#include "job/sequence_record.h"
#include "scene/camera_path.h"
#include "scene/default_light.h"
#include "scene/framing.h"
#include "scene/pose.h"
#include "scene/ray_caster.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

struct FilmEffort {
    std::string_view name;
    std::string_view preset;
    double noise;   // at which a frame is finished: root mean square of display values, 0 to 1
    uint32_t most;  // frames of the preset for one of the film
};

// More noise than stills have: a frame of a film is seen for a moment.
constexpr std::array filmEfforts = {FilmEffort{"draft", "balanced", 4.0 / 255.0, 64},
                                    FilmEffort{"normal", "still", 1.0 / 255.0, 64},
                                    FilmEffort{"high", "still", 0.3 / 255.0, 1024}};
constexpr uint32_t mostFrames = 100000;
constexpr uint32_t exposedSides = 8;
constexpr double exposureStep = 1.0 / 16.0;  // stops: devices that differ in the last bits agree

const FilmEffort& filmEffortOf(const std::string& name) {
    const auto* found = std::ranges::find(filmEfforts, name, &FilmEffort::name);
    if (found == filmEfforts.end()) {
        failUsage("--effort {}: must be draft, normal or high", name);
    }
    return *found;
}

SceneOptions lit(const SceneOptions& asked, const Scene& scene) {
    SceneOptions options = asked;
    options.placing.wholeTurn = true;
    const bool chosen = !asked.environment.empty() || !asked.viewFile.empty() || !asked.placing.sun.empty();
    if (!chosen && scene.fromFile && defaultView(scene).hasDefaultSun) {
        options.environment = "studio";
        printNote(
            fmt::format("{}: no light: added a studio; choose with --environment sky|studio|none|FILE", asked.scene));
    }
    return options;
}

bool turnsWithCamera(const TurntableOptions& options, const Scene& scene, const View& view) {
    if (!options.light.empty()) {
        return options.light == "camera";
    }
    return !scene.sun && isMadeEnvironment(view.environment.imageFile);
}

bool choosesCamera(const SceneOptions& options) {
    return !options.camera.empty() || !options.viewFile.empty() || !options.placing.orbit.empty() ||
           !options.placing.lookAt.empty();
}

/// Whether the scene's own camera has a roof above it.
bool showsRoom(const Scene& scene) {
    if (scene.cameras.empty()) {
        return false;
    }
    const Scene still = scene.nodes.empty() ? Scene{} : frozen(scene, 0.0);
    const Scene& placed = scene.nodes.empty() ? scene : still;
    const vec3 eye = posed(scene.cameras.front(), scenePose(scene, 0.0)).position;
    return bool(RayCaster(placed).cast(eye, vec3(0, 1, 0)));
}

vec3 pivotOf(const SceneOptions& options, const Scene& scene, const View& view, float aspect) {
    if (!choosesCamera(options)) {
        const TurningCamera turning = turningCamera(scene, aspect, view.time, std::nullopt);
        if (turning.pivot == turning.camera.position && view.camera.position == turning.pivot) {
            return turning.pivot;
        }
    }
    return scene.nodes.empty() ? orbitPivot(view.camera, scene) : orbitPivot(view.camera, frozen(scene, view.time));
}

// As often as fits best, so that the film loops: the animations play a little faster or slower than they are.
double playedDuring(const TurntableOptions& options, const Scene& scene) {
    const double duration = animationDuration(scene);
    if (!(duration > 0.0)) {
        failUsage("--animate: the scene has no animation");
    }
    return duration * std::max(std::round(options.seconds / duration), 1.0);
}

/// Renders one frame of the film after the other.
class FrameMaker {
public:
    FrameMaker(const RenderJob& job, const FilmEffort& effort) : job_(job), effort_(effort) {}

    // Frames at rest converge; the one that has little enough noise is copied to the host.
    void settle(const View& view) {
        job_.renderer.restart(0);  // as a still has it: what does not move in the film does not flicker
        NoiseMeter meter;
        uint32_t frames = effort_.most;
        for (uint32_t i = 0; i < frames; ++i) {
            const bool last = i + 1 == frames;
            const bool checks = meter.wants(i);
            render(view, last || checks);
            if (checks) {
                meter.add(i, job_.renderer.frame().bytes(display_));
            }
            const double ratio = meter.noise() / effort_.noise;
            if (meter.noise() > 0.0 && checks) {
                if (last || ratio <= 1.0) {
                    return;
                }
                frames = static_cast<uint32_t>(std::clamp((i + 1) * ratio * ratio, i + 2.0, double(effort_.most)));
            }
            stopIfAsked();
        }
    }

    void render(const View& view, bool copies) {
        job_.renderer.render(view, job_.size, job_.options.scene.seed, job_.settings,
                             [&](gpu::Frame& f, const FrameImages& images) {
                                 if (copies) {
                                     job_.pictures.request(f, images, false);
                                     display_ = f.readback(images.display);
                                 }
                             });
    }

    void write(const View& view, const std::vector<std::filesystem::path>& files) {
        for (const std::filesystem::path& file : files) {
            job_.pictures.write(file.string(), job_.renderer.frame(), view, job_.size);
        }
        ++written_;
    }

    [[nodiscard]] uint32_t written() const { return written_; }

private:
    void stopIfAsked() const {
        if (InterruptNote::arrived()) {
            fail("interrupted after {} frames; run the same command again to continue", written_);
        }
    }

    const RenderJob& job_;
    const FilmEffort& effort_;
    gpu::Readback display_;
    uint32_t written_ = 0;
};

nlohmann::ordered_json turntableRecord(const RenderJob& job, const Turntable& turntable, const FilmEffort& effort) {
    const RenderOptions& o = job.options;
    nlohmann::ordered_json record = commonRecord(o.scene, o.sequence, o.frames, turntable.first);
    record["device"] = job.device.description().name;
    record["turntable"] = {{"frames", turntable.frames},
                           {"pivot", {turntable.pivot.x, turntable.pivot.y, turntable.pivot.z}},
                           {"light_turns", turntable.lightTurns},
                           {"noise", effort.noise},
                           {"most", effort.most}};
    if (turntable.played > 0.0) {
        record["turntable"]["played"] = turntable.played;
    }
    record["show"] = o.show;
    for (const SettingEntry& entry : settingEntries()) {
        record["settings"][entry.name] = settingText(job.settings, entry);
    }
    return record;
}

}  // namespace

uint32_t turntableFrames(const TurntableOptions& options) {
    const double frames = std::round(options.seconds * options.render.sequence.fps);
    if (!(frames >= 2.0 && frames <= mostFrames)) {
        failUsage("--seconds {:g} at --fps {:g} are {:g} frames; a turntable has 2 to {}", options.seconds,
                  options.render.sequence.fps, frames, mostFrames);
    }
    return static_cast<uint32_t>(frames);
}

std::string_view turntablePreset(const std::string& effort) {
    return filmEffortOf(effort).preset;
}

View Turntable::view(uint32_t frame) const {
    const double turns = static_cast<double>(frame) / frames;
    View view = first;
    view.camera = orbit(view.camera, pivot, turns);
    view.time += played * turns;
    if (lightTurns) {
        const auto angle = static_cast<float>(std::remainder(2.0 * glm::pi<double>() * turns, 2.0 * glm::pi<double>()));
        view.sun.direction = mat3(glm::rotate(mat4(1.0F), angle, vec3(0, 1, 0))) * view.sun.direction;
        view.environment.rotation = std::remainder(view.environment.rotation + angle, 2.0F * pi);
    }
    return view;
}

Turntable makeTurntable(const TurntableOptions& options, const Scene& scene) {
    SceneOptions source = lit(options.render.scene, scene);
    const bool room = !choosesCamera(source) && showsRoom(scene);
    if (room) {
        source.camera = "0";
    }
    const uvec2 size = parseSize(source.size);
    Turntable turntable;
    turntable.first = loadView(source, scene);
    turntable.first.camera = posed(turntable.first, scene).camera;
    turntable.first.camera.node = -1;
    turntable.pivot =
        room ? turntable.first.camera.position : pivotOf(source, scene, turntable.first, float(size.x) / float(size.y));
    turntable.lightTurns = turnsWithCamera(options, scene, turntable.first);
    turntable.frames = turntableFrames(options);
    turntable.played = options.animated ? playedDuring(options, scene) : 0.0;
    return turntable;
}

Settings exposedForAll(const RenderJob& job, const Turntable& turntable) {
    Settings settings = job.settings;
    FrameMaker work(job, filmEfforts.front());
    double sum = 0.0;
    for (uint32_t side = 0; side < exposedSides; ++side) {
        job.renderer.restart(0);
        work.render(turntable.view(side * turntable.frames / exposedSides), true);
        const auto stops = job.pictures.autoExposure(job.renderer.frame());
        if (!stops) {
            return settings;
        }
        sum += *stops / exposedSides;
    }
    settings.tonemap.autoExposure = AutoExposure::off;
    settings.tonemap.exposure += static_cast<float>(std::round(sum / exposureStep) * exposureStep);
    return settings;
}

uint32_t renderTurntable(const RenderJob& job, const Turntable& turntable, const std::string& effort) {
    const InterruptNote note;
    const FilmEffort& how = filmEffortOf(effort);
    const SequenceOptions& sequence = job.options.sequence;
    const SequenceFiles files(job.options.outputs, sequence.firstFrame);
    for (const FrameNames& names : files.names()) {
        beginSequence(names, turntableRecord(job, turntable, how), sequence.overwrite, printWarning);
    }
    const SequencePlan plan{.frames = turntable.frames};
    const auto runs = plan.runs(parseShare(sequence.share), [&](uint32_t frame) { return files.isMissing(frame); });
    FrameMaker work(job, how);
    Progress progress("rendering frame", plan.work(runs), "frames an hour");
    for (const SequencePlan::Run& run : runs) {
        const auto missing = files.missing(run.begin);  // another process may have made some in the meantime
        if (!missing.empty()) {
            const View view = turntable.view(run.begin);
            job.renderer.blurSince(turntable.before(run.begin).camera);
            work.settle(view);
            work.write(view, missing);
        }
        progress.advance();
    }
    return work.written();
}

}  // namespace reflet
