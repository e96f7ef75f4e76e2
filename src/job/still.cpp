// Stills: frames at rest converge, so the last of many is the picture. How many: from the noise that is left.
#include "job/still.h"

#include "base/error.h"
#include "base/progress.h"
#include "job/noise_meter.h"
#include "renderer/presets.h"

#include <algorithm>
#include <array>

namespace reflet {

namespace {

using Clock = std::chrono::steady_clock;

struct Effort {
    std::string_view name;
    std::string_view preset;
    double seconds;  // at most
    double noise;    // at which the picture is finished: root mean square of display values, 0 to 1
};

constexpr std::array efforts = {Effort{"draft", "balanced", 8.0, 4.0 / 255.0},
                                Effort{"normal", "still", 30.0, 0.5 / 255.0},
                                Effort{"high", "still", 600.0, 0.2 / 255.0}};
constexpr uint32_t fewest = 2;   // frames: those before the last show no light of a second bounce on screen
constexpr uint32_t most = 4096;  // frames: histories do not grow beyond half of them

const Effort& effortOf(const RenderOptions& options) {
    const std::string_view name = options.effort.empty() ? "normal" : std::string_view(options.effort);
    const auto* found = std::ranges::find(efforts, name, &Effort::name);
    if (found == efforts.end()) {
        failUsage("--effort {}: must be draft, normal or high", name);
    }
    return *found;
}

double secondsOf(const RenderOptions& options) {
    return options.seconds > 0.0 ? options.seconds : effortOf(options).seconds;
}

}  // namespace

bool isStill(const RenderOptions& options) {
    const bool asked = !options.effort.empty() || options.seconds > 0.0;
    const bool one = !isSequence(options.outputs, options.sequence, options.frames) && options.frames == 0;
    if (asked && !one) {
        failUsage("--effort and --seconds are for a single picture, of which they choose the frames");
    }
    return asked || (one && !options.outputs.empty() && options.scene.preset.empty() && options.show == "final" &&
                     options.timings.empty());
}

std::string_view stillPreset(const RenderOptions& options) {
    return effortOf(options).preset;
}

std::string stillLimits(const RenderOptions& options) {
    const Effort& effort = effortOf(options);
    return fmt::format("at most {} s, or until its noise is {:.2g}", secondsOf(options), effort.noise);
}

void renderStill(const RenderJob& job, Clock::time_point start) {
    const Effort& effort = effortOf(job.options);
    const double limit = secondsOf(job.options);
    const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    Progress progress("rendering", most);
    NoiseMeter meter;
    uint32_t frames = most;
    double firstEnd = 0.0;
    for (uint32_t i = 0; i < frames; ++i) {
        const double before = elapsed();
        // The first frame compiles shaders, so that it tells nothing of the others.
        const double each = i > 1 ? (before - firstEnd) / (i - 1) : 0.0;
        const bool last = i + 1 >= fewest && (i + 1 == frames || before + 2.0 * each > limit);
        const bool checks = meter.wants(i);
        gpu::Readback display;
        job.renderer.render(job.view, job.size, job.options.scene.seed, job.settings,
                            [&](gpu::Frame& f, const FrameImages& images) {
                                if (last || checks) {
                                    job.pictures.request(f, images, job.settings.traceScreen.countSteps != 0);
                                    display = f.readback(images.display);
                                }
                            });
        job.timings.add(job.renderer.frame().passTimes());
        firstEnd = i == 0 ? elapsed() : firstEnd;
        if (checks) {
            meter.add(i, job.renderer.frame().bytes(display));
        }
        const double ratio = meter.noise() / effort.noise;
        if (last || (checks && meter.noise() > 0.0 && ratio <= 1.0)) {
            break;
        }
        if (checks && meter.noise() > 0.0) {
            frames = static_cast<uint32_t>(std::clamp((i + 1) * ratio * ratio, i + 2.0, double(most)));
        }
        const double inTime = each > 0.0 ? (i + 1) + (limit - elapsed()) / each : double(most);
        progress.expect(static_cast<uint64_t>(std::clamp(inTime, i + 2.0, double(frames))));
        progress.set(i + 1, meter.noise() > 0.0 ? fmt::format("noise {:.2g}", meter.noise()) : "");
    }
}

}  // namespace reflet
